#include "cli/scene_arguments.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "scene/model_scene.h"
#include "scene/scene_file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr const char* kStandard = "quick";  // the config whose methods a scene gets without one

}  // namespace

bool is_scene_path(const std::string& argument) {
  const std::string path = parse_scene_name(argument).scene;
  std::error_code ec;
  return is_model(path) || fs::path(path).filename() == "scene.json" ||
         (is_path(path) && fs::is_regular_file(fs::path(path) / "scene.json", ec));
}

bool is_scene_name(const std::string& argument) {
  const std::string name = parse_scene_name(argument).scene;
  std::error_code ec;
  return !name.empty() && !is_path(name) &&
         fs::is_regular_file(data_root() / "scenes" / name / "scene.json", ec) &&
         !fs::exists(data_root() / "configs" / (name + ".json"), ec);
}

ExperimentOption::ExperimentOption(CLI::App* command) : given_(std::make_shared<Given>()) {
  command->add_option("config", given_->config,
                      "experiment: a file, or the name of one in configs/ (default with --scene: quick)");
  command
      ->add_option(
          "--scene", given_->scenes,
          "a glTF file, a scene.json or a scene's name, each perhaps with :VIEW, in place of the config's "
          "scenes; may come again")
      ->allow_extra_args(false);
}

Experiment ExperimentOption::get() const {
  Experiment e{{}, {given_->scenes, false}};
  std::string config = given_->config;
  if (is_scene_path(config) || (e.scenes.scenes.empty() && is_scene_name(config))) {
    e.scenes.scenes.insert(e.scenes.scenes.begin(), config);
    log_info("{} is a scene: the methods are those of configs/{}.json; others: CONFIG --scene {}", config,
             kStandard, config);
    config.clear();
  }
  if (config.empty() && e.scenes.scenes.empty())
    throw fail(ErrorKind::usage,
               "no experiment: give a config, such as configs/quick.json, or --scene model.glb");
  e.scenes.names_it = config.empty();
  e.config = config_path(config.empty() ? kStandard : config);
  return e;
}

}  // namespace vsglbench
