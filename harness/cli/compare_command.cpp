#include <fmt/format.h>

#include "answer/compare.h"
#include "cli/command.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct CompareCommand {
  fs::path base, now;
  CompareOptions options;
  bool markdown = false;
};

}  // namespace

void add_compare_command(CLI::App& app, CommandResult* result) {
  auto options = std::make_shared<CompareCommand>();
  CLI::App* command =
      app.add_subcommand("compare", "what became faster, slower, better or worse between two reports");
  command->footer(
      "Times: ratios of medians with their intervals, per case and, a pair a case, per pass, over all cases "
      "and over those\nof one method. A change is one beyond its interval, the A/A noise of both reports, "
      "0.5 %, "
      "and a probability of\nsuperiority of 0.8. Errors: seeds are pairs.\nRefused: other formulas, other "
      "references, other devices (unless --ratios or "
      "--other-device), cases of one\nname whose settings differ, as by `run --set` (unless "
      "--other-settings).\n"
      "With byte-equal kernels, plugins and driver on one device, differences of time are noise: they are "
      "listed, and the exit code is 0\nunless errors are worse.\n"
      "Exit codes: 0 nothing is worse, 4 something is, 5 refused, or a pass may be slower and can't be "
      "told.\n"
      "Example: vsglbench compare reports/front-lavapipe reports/out/front");
  command->add_option("base", options->base, "report.json, or its folder")->required();
  command->add_option("new", options->now, "report.json, or its folder")->required();
  command->add_flag(
      "--ratios", options->options.ratios,
      "compare times over what their whole scene takes longer (the median over the stages of all cases), "
      "which holds on any machine");
  command->add_flag("--other-device", options->options.other_device,
                    "compare times of two devices all the same");
  command->add_flag("--other-settings", options->options.other_settings,
                    "compare cases of one name whose settings differ all the same");
  command->add_flag("--markdown", options->markdown, "as Markdown, for a pull request");
  command->callback([=] {
    const Comparison c =
        compare_reports(read_report_at(options->base), read_report_at(options->now), options->options);
    fmt::print("{}", comparison_text(c, options->markdown));
    result->exit_code = c.exit_code();
  });
}

}  // namespace vsglbench
