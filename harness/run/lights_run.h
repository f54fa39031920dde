// `vsglbench lights`: the lights of an experiment's cases as pictures, as a list, and as overlap and gap.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "lights/coverage.h"
#include "lights/light_list.h"
#include "report/report.h"
#include "run/scene_choice.h"
#include "run/scene_pdfs.h"

namespace vsglbench {

struct LightsOptions {
  std::filesystem::path config;
  std::string scale;               // of the config's `scales`; empty: none
  SceneChoice scenes;              // in place of the config's
  std::filesystem::path out;       // empty: reports/out/<name of the config>/lights
  std::filesystem::path assets;    // empty: $VSGLBENCH_ASSETS
  std::vector<std::string> cases;  // globs over their ids; empty: all
  std::string device;              // as in select_device()
  uint32_t seed = 0;               // whose lights are drawn and listed
  uint32_t seeds = 1;              // coverage.csv has this many from there on
  bool csv = false;                // lights.csv instead of lights.json
  std::vector<std::string> argv;
};

// What became of one case with one seed. Of the first seed, `folder` below the output folder holds rsm.png,
// scene.png, moments.png where the method filters the RSM by its mips, and the list.
struct LightsResult {
  std::string id;
  uint32_t seed = 0;
  Status status = Status::ok;
  std::string error;  // one line, where it is not ok
  std::filesystem::path folder;
  uint64_t lights = 0, empty = 0;
  std::optional<Coverage> coverage;
  std::optional<KernelStats> kernels;
  std::optional<EdgeEffect> edges;  // of a method with square footprints
};

// As messages of the process that draws.
Json to_json(const LightsResult& result);
void from_json(const Json& json, LightsResult* result);

// The lights that a frame of this seed has, of the first iteration where the case has several. With `shared`
// they are drawn from those PDFs, as a run that measures generation alone does; else from the case's own.
// Draws the halves, the RSM of `rsm` texels a side; visibility and shading are left out. Throws
// Error(case_failed) for lights with a NaN or Inf.
LightSet make_lights(Frame& frame, uint32_t seed, const KeptPdfs* shared, uint32_t rsm);

// Draws and writes each case with the first seed, and a row for each case and seed in coverage.csv. A case
// that fails, crashes or hangs (Config::time_limit_s), or whose scene is not on this machine, costs itself.
// For a process without threads and without a Vulkan device: it forks. Throws Error for what stops all:
// config, cases, output folder, device.
std::vector<LightsResult> run_lights(const LightsOptions& options);

}  // namespace vsglbench
