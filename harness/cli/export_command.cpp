#include <fmt/format.h>

#include "base/file.h"
#include "cli/command.h"
#include "report/export.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct ExportCommand {
  fs::path report, out;
  std::string format;
};

void write(const ExportCommand& command) {
  const std::string text = export_report(read_report_at(command.report), command.format).dump(2) + "\n";
  command.out.empty() ? fmt::print("{}", text) : write_text(command.out, text);
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportCommand>();
  CLI::App* command = app.add_subcommand("export", "a report in the formats of other dashboards");
  command->footer(
      "bencher           Bencher Metric Format: latency (ns, of the method's passes), frame-latency, smape, "
      "rmse, flip\n"
      "github-action     github-action-benchmark's customSmallerIsBetter: ms and % alone\n"
      "google-benchmark  as Google Benchmark's JSON: real_time is the median of the method's passes, errors "
      "are counters\n"
      "Example: vsglbench export reports/quick-lavapipe --format bencher --out metrics.json");
  command->add_option("report", options->report, "report.json, or its folder")->required();
  command->add_option("--format", options->format, fmt::format("{}", fmt::join(export_formats(), ", ")))
      ->required();
  command->add_option("--out", options->out, "file (default: standard output)");
  command->callback([=] { write(*options); });
}

}  // namespace vsglbench
