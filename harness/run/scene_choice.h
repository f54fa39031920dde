// Scenes from the command line, in place of a config's.
#pragma once

#include "run/config.h"

namespace vsglbench {

struct SceneChoice {
  std::vector<std::string> scenes;  // empty: the config's
  bool names_it = false;            // the experiment is named after the first of them, not after the config
};

// load_config() of a config whose `scenes` are those of `choice`. What is wrong with them is Error(usage).
Config load_config(const std::filesystem::path& path, const Overrides& overrides, const std::string& scale,
                   const SceneChoice& choice);

}  // namespace vsglbench
