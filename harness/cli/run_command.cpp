#include <fmt/format.h>

#include "cli/command.h"
#include "report/table.h"
#include "run/runner.h"

namespace vsglbench {

void add_run_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result) {
  auto options = std::make_shared<RunOptions>();
  auto config = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("run", "measure the cases of an experiment and write report.json");
  command->footer(
      "Example: vsglbench run configs/sponza.json --assets ~/scenes --only '*/mfis/*'\n"
      "An interrupted run goes on where it stopped when it is started again.");
  command->add_option("config", *config, "experiment: a file, or the name of one in configs/")->required();
  command->add_option("--out", options->out, "folder of the report (default reports/out/NAME)");
  command->add_option("--only", options->only, "run only the cases whose id matches this glob");
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->device, "Vulkan device: index or part of its name");
  command->add_flag("--force", options->force, "measure again what an interrupted run had finished");
  command->add_flag("--validate", options->validation, "with Vulkan's validation layers (slow); a message is an error");
  command->callback([=] {
    options->config = config_path(*config);
    options->argv = argv;
    const RunOutcome outcome = run_config(*options);
    fmt::print("{}", terminal_table(outcome.report));
    const WallTime& w = outcome.wall;
    fmt::print("{}: {:.1f} s, of which frames on the device {:.1f}, references {:.1f}, exact visibility {:.1f}, "
               "compilation {:.1f}; the rest is {:.2f} x the device time\n",
               outcome.report_path.string(), w.total, w.device, w.references, w.visibility, w.compilation,
               w.overhead_ratio());
    result->exit_code = outcome.exit_code;
  });
}

}  // namespace vsglbench
