// A whole run: config → scenes → cases → report, saved after every scene, resumable.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/report.h"
#include "run/activity.h"
#include "run/scene_choice.h"

namespace vsglbench {

struct RunOptions {
  std::filesystem::path config;
  std::filesystem::path out;      // empty: reports/out/<name of the config>
  std::filesystem::path assets;   // empty: $VSGLBENCH_ASSETS
  std::vector<std::string> only;  // globs over case ids; empty: all
  std::vector<std::string> set;   // "KEY=VALUE", in place of what the config says
  std::string scale;              // of the config's `scales`; empty: none
  SceneChoice scenes;             // in place of the config's
  std::string device;             // as in select_device()
  bool force = false;             // measure again what an interrupted run had finished
  // A complete report of the same experiment, program and device stands; what failed there, was skipped, or
  // has lost its pictures is tried again.
  bool keep_complete = false;
  bool validation = false;     // with the validation layers; a message fails the run
  bool check_passes = false;   // every pass by itself, its outputs looked at: FrameParameters::check_passes
  uint32_t price_effects = 0;  // replaces the config's; 0: the config's
  double time_limit_s = 0;     // replaces the config's; 0: the config's
  Announce sabotage;           // tests only, see WorkerOptions
  std::vector<std::string> argv;
};

struct RunOutcome {
  Report report;
  std::filesystem::path report_path;
  std::vector<std::string> validation_messages;
  // 0 all cases ok (skipped ones count as ok); 1 a case failed or the validation layers had something to say;
  // 3 the device was lost for good (the report is then incomplete, and the run can be gone on with)
  int exit_code = 0;
};

// Whatever a case has shown is on the disk at once, in the journal beside the report: an interruption at any
// moment, `kill -9` among them, loses the frames at hand and nothing else, and the same command goes on. The
// report itself is saved after every scene. For a process without threads and without a Vulkan device: it
// forks. Throws Error for what stops the whole run: config, output folder, no device at the start.
RunOutcome run_config(const RunOptions& options);

// The options' folder, or VSGLBENCH_ASSETS, or empty.
std::filesystem::path assets_directory(const std::filesystem::path& given);

}  // namespace vsglbench
