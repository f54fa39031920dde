// An experiment file: scene × method × parameters, each as a list to sweep. Documented in configs/README.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measure/stopping.h"
#include "reference/reference.h"
#include "report/report.h"
#include "run/sweep.h"

namespace vsglbench {

struct ReferenceSettings {
  uint32_t samples = 256, batches = 16;
  uint64_t seed = 1;
  double floor = 0;           // percent; 0: none
  double time_limit_s = 600;  // of the search for `floor`; without one, none
  ShadingNormals shading_normals = ShadingNormals::light;
};

// Flicker is measured over the first frames of a scene in motion.
struct MotionSettings {
  uint32_t frames = 0;  // at most; 0: all that the scene has
  uint32_t seeds = 4;   // of every randomised method; each renders all frames
};

struct Config {
  std::string name, description;
  Measure measure = Measure::frame;
  std::vector<std::string> scenes;
  std::vector<Case> cases;  // scene by scene, in the order of the file
  uint32_t seeds = 8;       // of every randomised method
  uint32_t warmup = 1;
  double time_limit_s = 600;  // of one action of a case, such as a frame: after that it hangs
  StoppingRule timing{0.02, 8, 200, 30};
  ReferenceSettings reference;
  uint32_t price_effects = 0;            // rounds of frames that price the scenes' ledgers; 0: none
  std::optional<MotionSettings> motion;  // nothing: frame 0 alone is looked at
  Json resolved;                         // with every default filled in: the report's `config`
};

// Throws Error(config) "FILE:LINE: ..." for anything unknown, of a wrong type, out of range, a scene that
// does not exist, or a sweep that makes the same case twice. `scale` is a name of the file's `scales`, whose
// keys replace the file's; empty: none. `overrides` (run/overrides.h) replace what the file says.
Config load_config(const std::filesystem::path& path, const Overrides& overrides = Json::object(),
                   const std::string& scale = "");

// The schema of an experiment file.
const Json& config_schema();

// A path as it is; a bare name as configs/NAME.json of the data folder. Throws Error(config) naming the
// nearest one when that does not exist.
std::filesystem::path config_path(const std::string& name_or_path);

}  // namespace vsglbench
