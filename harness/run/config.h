// An experiment file: scene × method × parameters, each as a list to sweep. Documented in configs/README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "measure/stopping.h"

namespace vsglbench {

struct ReferenceSettings {
  uint32_t samples = 256, batches = 16;
  uint64_t seed = 1;
};

// One point of the sweep.
struct Case {
  std::string id;      // "cornell/mfis/N=256,rsm=256,vis=exact"
  std::string scene;   // as a config writes it, "sponza:A_author_aisle"
  std::string method;
  FrameParameters frame;
  Json method_parameters;  // resolved
  Json parameters;         // everything resolved, for the report
};

struct Config {
  std::string name, description;
  std::vector<std::string> scenes;
  std::vector<Case> cases;  // scene by scene, in the order of the file
  uint32_t seeds = 8;       // of every randomised method
  uint32_t warmup = 1;
  StoppingRule timing{0.02, 8, 200, 30};
  ReferenceSettings reference;
  Json resolved;  // for the report
};

// Throws Error(config) "FILE:LINE: ..." for anything unknown, of a wrong type, out of range, or a sweep that
// makes the same case twice.
Config load_config(const std::filesystem::path& path);

// configs/NAME.json for a bare name, the path itself else.
std::filesystem::path config_path(const std::string& name_or_path);

}  // namespace vsglbench
