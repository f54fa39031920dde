#include "cli/sweep_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>

#include "base/child.h"
#include "base/error.h"
#include "base/printable.h"
#include "cli/scene_arguments.h"
#include "sweep/device_choice.h"
#include "sweep/merge.h"
#include "sweep/scene_references.h"
#include "sweep/shard_run.h"
#include "sweep/status.h"
#include "sweep/submit.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

void print_plan(const SweepPlan& plan, const fs::path& out) {
  size_t least = SIZE_MAX, most = 0;
  for (const Shard& s : plan.shards) {
    least = std::min(least, s.cases.size());
    most = std::max(most, s.cases.size());
  }
  const size_t again = plan.measurements() - plan.case_ids().size();
  fmt::print("{} cases of {} scenes in {} shards of {} cases{}\n{}\n", plan.case_ids().size(),
             plan.scenes().size(), plan.shards.size(),
             least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most),
             again > 0 ? fmt::format(", which measure anchors {} times more", again) : "",
             printable((out / kPlanFile).string()));
}

void add_plan(CLI::App& sweep) {
  struct Options {
    RunOptions run;
    std::string shards_by = "scene";
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = sweep.add_subcommand("plan", "divide an experiment into shards: DIR/plan.json");
  const ExperimentOption experiment(command);
  command->add_option("--out", options->run.out, "folder of the sweep, which all its machines see")
      ->required();
  command
      ->add_option(
          "--shards-by", options->shards_by,
          "scene: a shard a scene and view; block:N: also split those of more than N cases, each block "
          "with the\nsame anchor case and its A/A twin")
      ->capture_default_str();
  command->add_option("--only", options->run.only, "as of run")->allow_extra_args(false);
  command->add_option("--set", options->run.set, "as of run")->allow_extra_args(false);
  command->add_option("--scale", options->run.scale, "as of run");
  command->add_option("--assets", options->run.assets,
                      "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->callback([=] {
    const Experiment given = experiment.get();
    options->run.config = given.config;
    options->run.scenes = given.scenes;
    options->run.assets = assets_directory(options->run.assets);
    const SweepPlan plan = make_plan(options->run, options->shards_by);
    write_plan(options->run.out, plan);
    print_plan(plan, options->run.out);
  });
}

// What scancel sends first, and what a person sends.
void on_stop(int signal) { stop_shard(signal); }

void print_task(size_t shard, const TaskOutcome& o) {
  if (o.what == TaskOutcome::What::held) {
    fmt::print("shard {}: left to {}\n", shard_name(shard), printable(o.holder.told()));
    return;
  }
  fmt::print("shard {}: {}{} cases ok, {} failed, {} skipped\n{}\n", shard_name(shard),
             o.what == TaskOutcome::What::was_done ? "done before: " : "", o.cases.ok, o.cases.failed,
             o.cases.skipped, printable(o.folder.string()));
}

void run_task(const fs::path& sweep, size_t shard, const TaskOptions& options, CommandResult* result) {
  for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, on_stop);
  try {
    const TaskOutcome outcome = run_shard(sweep, shard, options);
    print_task(shard, outcome);
    result->exit_code = outcome.exit_code;
  } catch (const WrongDevice& e) {
    std::fputs(("vsglbench: " + excerpt(e.what(), kLongestMessage) + "\n").c_str(), stderr);
    result->exit_code = kWrongDevice;
  } catch (const Error&) {
    const int signal = shard_stopped_by();
    if (signal == 0) throw;
    std::signal(signal, SIG_DFL);  // its end is written; now as the signal wants
    std::raise(signal);
  }
}

void add_run(CLI::App& sweep, CommandResult* result) {
  struct Options {
    fs::path sweep;
    size_t shard = 0;
    TaskOptions task;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = sweep.add_subcommand("run", "measure one shard; what a task of an engine calls");
  command->footer(
      "Without --device the GPU is that of CUDA_VISIBLE_DEVICES, which Vulkan does not read, found by its "
      "UUID.\n"
      "Exit codes: as of run, and 6: the task stands on another device than the wanted one, and reports "
      "nothing.");
  command->add_option("dir", options->sweep, "folder of the sweep")->required();
  command->add_option("shard", options->shard, "its number, from 0")->required();
  command->add_option("--device", options->task.device, "as of run");
  command->add_option("--require-device", options->task.require,
                      "part of the name that the device must have, or its UUID");
  command->callback([=] { run_task(options->sweep, options->shard, options->task, result); });
}

void add_references(CLI::App& sweep) {
  auto options = std::make_shared<std::pair<fs::path, size_t>>();
  CLI::App* command = sweep.add_subcommand(
      "references", "compute the references of one scene into the cache, without a device");
  command->add_option("dir", options->first, "folder of the sweep")->required();
  command->add_option("scene", options->second, "its number, from 0")->required();
  command->callback([=] {
    const MadeReferences made = make_references(options->first, options->second);
    if (made.impossible.empty())
      fmt::print("{}: {} references\n", printable(made.scene), made.count);
    else
      fmt::print("{}: no references: {}\n", printable(made.scene), excerpt(made.impossible, kLongestMessage));
  });
}

struct SubmitCommand {
  fs::path sweep;
  std::string engine;
  SubmitOptions submit;
};

void submit(const SubmitCommand& command, bool again, CommandResult* result) {
  SubmitOptions options = command.submit;
  options.engine = engine_named(command.engine);
  if (options.gres == "none") options.gres.clear();
  const SweepStatus status = status_of(command.sweep);
  const std::vector<size_t> open = status.open(options.require);
  const bool begun = status.count(ShardState::missing) < status.shards.size();
  if (!again && begun) {
    throw fail(ErrorKind::usage, "{}: the sweep has begun; vsglbench sweep resubmit runs what is open",
               command.sweep.string());
  }
  if (open.empty()) {
    fmt::print("no shard is open: {} done, {} running\n", status.count(ShardState::done),
               status.count(ShardState::running));
    return;
  }
  fmt::print("{} shards: {}\n", open.size(), index_list(open));
  const SubmitScripts scripts = write_scripts(command.sweep, status.plan, open, options);
  if (options.engine == Engine::print) {
    fmt::print("{}\n", printable(scripts.all.string()));
    return;
  }
  // GNU parallel's exit code is the number of tasks that failed; what did is for status to say.
  if (run_scripts(scripts, options.engine) != 0) {
    throw fail(ErrorKind::case_failed, "{}: not every task went well; see vsglbench sweep status {}",
               scripts.all.filename().string(), command.sweep.string());
  }
  result->exit_code = 0;
}

void add_submit(CLI::App& sweep, bool again, CommandResult* result) {
  auto options = std::make_shared<SubmitCommand>();
  CLI::App* command =
      sweep.add_subcommand(again ? "resubmit" : "submit",
                           again ? "run the shards that are neither done nor running, as submit does"
                                 : "run all shards by an engine");
  command->add_option("dir", options->sweep, "folder of the sweep")->required();
  command
      ->add_option(
          "--engine", options->engine,
          "slurm: job arrays; parallel: GNU parallel, here or over ssh; print: the scripts for Slurm, "
          "started by you")
      ->required();
  command->add_option(
      "--require-device", options->submit.require,
      again ? "as of run; shards that are done on another device alone are run again, too" : "as of run");
  command->add_option("--gres", options->submit.gres, "what a measuring task asks Slurm for; none: nothing")
      ->capture_default_str();
  command->add_option("arguments", options->submit.arguments, "after --: for sbatch, or for parallel");
  command->callback([=] { submit(*options, again, result); });
}

void add_status(CLI::App& sweep, CommandResult* result) {
  auto options = std::make_shared<std::pair<fs::path, bool>>();
  CLI::App* command =
      sweep.add_subcommand("status", "which shards are done, running, failed and why, missing");
  command->footer("Exit codes: 0 all done, 1 a case failed, 5 a shard is open.");
  command->add_option("dir", options->first, "folder of the sweep")->required();
  command->add_flag("--json", options->second, "as JSON");
  command->callback([=] {
    const SweepStatus status = status_of(options->first);
    fmt::print("{}", options->second ? to_json(status).dump(1) + "\n" : status_text(status));
    result->exit_code = status.exit_code();
  });
}

void add_merge(CLI::App& sweep, CommandResult* result) {
  auto dir = std::make_shared<fs::path>();
  CLI::App* command = sweep.add_subcommand("merge", "one report of all shards: DIR/merged/CLASS/report.json");
  command->footer(
      "A report for each class of devices (name, driver, subgroup size). Refused, with nothing written: "
      "shards of "
      "another\nconfig, programme, kernels, formulas or references.\n"
      "Exit codes: 0 complete, 1 a case failed, 5 cases are missing, or refused.");
  command->add_option("dir", *dir, "folder of the sweep")->required();
  command->callback([=] {
    const MergeOutcome outcome = merge_sweep(*dir);
    fmt::print("{}", merge_text(outcome));
    result->exit_code = outcome.exit_code();
  });
}

}  // namespace

void add_sweep_command(CLI::App& app, CommandResult* result) {
  CLI::App* sweep =
      app.add_subcommand("sweep", "one experiment over many machines: plan, submit, status, merge");
  sweep->require_subcommand(1);
  sweep->footer(
      "Example: vsglbench sweep plan front --out /shared/front --shards-by block:50 && vsglbench sweep "
      "submit\n"
      "/shared/front --engine slurm -- -p gpu; vsglbench sweep status /shared/front; vsglbench sweep merge "
      "/shared/front");
  add_plan(*sweep);
  add_references(*sweep);
  add_run(*sweep, result);
  add_submit(*sweep, false, result);
  add_status(*sweep, result);
  add_submit(*sweep, true, result);
  add_merge(*sweep, result);
  for (CLI::App* command : sweep->get_subcommands({})) command->fallthrough();
}

}  // namespace vsglbench
