#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "base/child.h"
#include "base/error.h"
#include "base/percent.h"
#include "cli/command.h"
#include "cli/scene_arguments.h"
#include "cli/terminal.h"
#include "report/ledger.h"
#include "report/noise.h"
#include "report/table.h"
#include "report/table_notes.h"
#include "run/config.h"
#include "run/runner.h"

namespace vsglbench {
namespace {

// Says what becomes of the run, then ends as the signal wants: nothing is half written, and what was found is
// on the disk already.
void on_interrupt(int signal) {
  static const char message[] = "\nvsglbench: interrupted; the same command goes on where this one ended\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
  kill_children();  // with what a method has started there
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void print_outcome(const RunOutcome& outcome) {
  fmt::print("{}", terminal_table(outcome.report, {.width = terminal_width()}));
  for (const SceneReport& scene : outcome.report.scenes)
    if (!scene.effects.empty()) fmt::print("{}", short_ledger(scene));
  fmt::print("{}\n{}\n", outcome.report_path.string(), wall_text(outcome.report.wall));
}

// "5%" as 0.05.
double share_of(const std::string& text) {
  const double percent = parse_percent(text).value_or(0);
  if (percent <= 0)
    throw fail(ErrorKind::usage, "--require-noise takes a percentage above 0, such as 5%, not '{}'", text);
  return percent / 100;
}

// `noise`: of --require-noise; empty: any.
void run(const RunOptions& options, const std::string& noise, CommandResult* result) {
  const double limit = noise.empty() ? 0 : share_of(noise);

  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  const RunOutcome outcome = run_config(options);
  print_outcome(outcome);
  std::fflush(stdout);
  result->exit_code = outcome.exit_code;
  const auto& messages = outcome.validation_messages;
  if (!messages.empty()) {
    throw fail(ErrorKind::case_failed, "the validation layers gave {} messages, the first: {}",
               messages.size(), messages.front());
  }
  const auto too_noisy = noise.empty() ? std::nullopt : noise_over(outcome.report, limit);
  if (too_noisy) throw fail(ErrorKind::case_failed, "{}", *too_noisy);
}

// Why an option can't take these; nothing where it can. Lists, as --set takes them, too.
std::string problem_of_effects(const std::string& effects) {
  if (effects.starts_with('[')) return "";
  try {
    parse_effects(effects);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

void add_run_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result) {
  auto options = std::make_shared<RunOptions>();
  auto noise = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("run", "measure the cases of an experiment and write report.json");
  command->footer(
      "What a case shows is on the disk at once; an interrupted run goes on when the same command is given "
      "again. Cases run in\nprocesses of their own: one that crashes, hangs or loses the device fails, and "
      "the "
      "rest goes on. A complete report in\nthe folder is kept as report.previous.json; images are replaced.\n"
      "Examples: vsglbench run configs/sponza.json --assets ~/scenes --only '*/mfis/*'; vsglbench run "
      "--scene "
      "model.glb --scale small");
  const ExperimentOption experiment(command);
  command->add_option("--out", options->out, "folder of the report (default reports/out/NAME)")
      ->check([](const std::string& out) { return std::string(out.empty() ? "needs a folder" : ""); });
  command
      ->add_option("--only", options->only,
                   "run only the cases whose id matches one of these globs; may come again")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--set", options->set,
          "KEY=VALUE, such as N=64, visibility=none or rsm=[64,128]: in place of what the config says "
          "of this key for any method; may come again (keys: vsglbench list keys)")
      ->allow_extra_args(false);
  for (const auto& [name, help] :
       {std::pair("force_effects", "all, or NAME,…: simulate these though the scene does not call for them"),
        std::pair("skip_effects",
                  "all, or NAME,…: leave these out though it does (vsglbench effects SCENE)")}) {
    const std::string key = name;
    std::string option = "--" + key;
    std::ranges::replace(option, '_', '-');
    command
        ->add_option_function<std::string>(
            option, [=](const std::string& effects) { options->set.push_back(key + "=" + effects); }, help)
        ->check([](const std::string& effects) { return problem_of_effects(effects); });
  }
  command
      ->add_flag("--price-effects{8}", options->price_effects,
                 "time frames with and without each effect, after everything else of a scene, and write "
                 "what it costs\nor saves into the report; --price-effects=ROUNDS of frames, 8 if not "
                 "given (default: the config's, none)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--scale", options->scale,
                      "of the config's scales, such as quick: its keys replace the config's");
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command
      ->add_option(
          "--time-limit", options->time_limit_s,
          "seconds that one action of a case may take before it counts as hanging (default: the config's, "
          "600)")
      ->check(CLI::Range(1e-3, 1e6));
  command->add_option(
      "--require-noise", *noise,
      "fail a run, after everything is written, whose A/A pairs show more noise than this in any time "
      "(5%)");
  command->add_flag("--force", options->force, "measure again what an interrupted run had finished");
  command->add_flag(
      "--check-passes", options->check_passes,
      "submit every pass by itself and name the first, with its texel, that writes a NaN or Inf "
      "(slow; times\nare not comparable)");
  command->add_flag("--validate", options->validation,
                    "with Vulkan's validation layers (slow); a message fails the run");
  command->callback([=] {
    const Experiment given = experiment.get();
    options->config = given.config;
    options->scenes = given.scenes;
    options->argv = argv;
    run(*options, *noise, result);
  });
}

}  // namespace vsglbench
