// `--scene` of the commands that measure an experiment, and scenes given in place of one.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "run/scene_choice.h"

namespace vsglbench {

// What a command runs: a config and, where scenes were given, these in place of its own.
struct Experiment {
  std::filesystem::path config;
  SceneChoice scenes;
};

// The config as a positional argument, and --scene, which may come again. One of both must be given.
class ExperimentOption {
 public:
  explicit ExperimentOption(CLI::App* command);
  // Without a config the scenes get the methods of configs/quick.json, and a glTF file or a scene.json in the
  // config's place is a scene, too, which is said. Throws Error(config), or Error(usage) where nothing was
  // given.
  Experiment get() const;

 private:
  struct Given {
    std::string config;
    std::vector<std::string> scenes;
  };
  std::shared_ptr<Given> given_;
};

// Whether an argument is a scene where a config could stand, too: a glTF file, a scene.json or the folder of
// one, each perhaps with ":VIEW".
bool is_scene_path(const std::string& argument);

// Whether it names one of scenes/, and no config.
bool is_scene_name(const std::string& argument);

}  // namespace vsglbench
