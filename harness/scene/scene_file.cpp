#include "scene/scene_file.h"

#include <fnmatch.h>

#include <algorithm>

#include "base/file.h"
#include "base/json.h"
#include "base/nearest.h"
#include "scene/builders.h"
#include "scene/check.h"
#include "scene/gltf.h"
#include "scene/scene_objects.h"
#include "scene/scene_view.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct SceneFile {
  fs::path path;     // of the scene.json
  std::string view;  // empty for the default one
};

// Folders of scenes_dir that hold a scene.json, by name.
std::vector<std::string> scene_folders(const fs::path& scenes_dir) {
  std::vector<std::string> names;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(scenes_dir, ec)) {
    if (fs::is_regular_file(entry.path() / "scene.json", ec))
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

SceneFile locate(const std::string& name_or_path, const SceneOptions& options) {
  const auto [name, chosen] = parse_scene_name(name_or_path);
  const std::string view = chosen.value_or("");
  if (chosen && view.empty())
    throw fail(ErrorKind::scene, "scene '{}': no view after the colon", name_or_path);
  std::error_code ec;
  if (is_path(name)) {
    const fs::path path = name;
    return {fs::is_directory(path, ec) ? path / "scene.json" : path, view};
  }
  const fs::path file = options.scenes_dir / name / "scene.json";
  if (name.empty() || !fs::is_regular_file(file, ec)) {
    throw fail(ErrorKind::scene, "unknown scene '{}' in {}{}", name, options.scenes_dir.string(),
               suggestion(name, scene_folders(options.scenes_dir)));
  }
  return {file, view};
}

JsonDocument load_document(const fs::path& file) {
  static const Json schema =
      JsonDocument::load(data_root() / "harness" / "scene" / "scene.schema.json", ErrorKind::scene).root();
  JsonDocument document = JsonDocument::load(file, ErrorKind::scene);
  check_schema(document, schema);
  const Json& root = document.root();
  const Json& geometry = root.at("geometry");
  if (geometry.contains("file") == geometry.contains("builder")) {
    throw document.error("/geometry", "must have either 'file' or 'builder'");
  }
  if (geometry.contains("file") && geometry.contains("parameters")) {
    throw document.error("/geometry/parameters", "is for a builder, not for a file");
  }
  if (geometry.contains("builder")) {
    for (const char* key : {"unit", "view_unit"}) {
      if (root.contains(key))
        throw document.error(std::string("/") + key, "is for a file; builders use metres");
    }
  }
  return document;
}

std::vector<std::string> view_names(const Json& root) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : root.at("views").items()) names.push_back(name);
  return names;
}

// The view that `wanted` names, or the default one.
std::string choose_view(const JsonDocument& document, const std::string& wanted) {
  const std::vector<std::string> names = view_names(document.root());
  const std::string name = wanted.empty() ? document.root().at("default_view").get<std::string>() : wanted;
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw document.error(wanted.empty() ? "/default_view" : "/views",
                         fmt::format("has no view '{}'{}", name, suggestion(name, names)));
  }
  return name;
}

// The geometry file: beside scene.json, else in the assets folder; where it should be when it is in neither.
fs::path asset_path(const JsonDocument& document, const SceneOptions& options) {
  const std::string file = document.root().at("geometry").at("file").get<std::string>();
  const fs::path beside = fs::path(document.name()).parent_path() / file;
  std::error_code ec;
  if (options.assets_dir.empty() || fs::exists(beside, ec)) return beside;
  return options.assets_dir / file;
}

void load_asset(const JsonDocument& document, const SceneOptions& options, double unit, Scene* scene) {
  const Json& root = document.root();
  const std::string file = root.at("geometry").at("file").get<std::string>();
  const fs::path path = asset_path(document, options);
  std::error_code ec;
  if (!fs::exists(path, ec)) {
    if (!root.contains("get_it")) {
      throw document.error("/geometry/file", fmt::format("names {}, which does not exist", path.string()));
    }
    const std::string where = options.assets_dir.empty()
                                  ? "no assets folder was given (--assets DIR or VSGLBENCH_ASSETS)"
                                  : fmt::format("{} does not hold it", options.assets_dir.string());
    throw fail(ErrorKind::asset_missing, "scene {} needs {}; {}; to get it: {}",
               root.at("name").get<std::string>(), file, where, root.at("get_it").get<std::string>());
  }
  load_gltf(path, unit, scene);
}

void load_geometry(const JsonDocument& document, const SceneOptions& options, double unit, Scene* scene) {
  const Json& geometry = document.root().at("geometry");
  if (geometry.contains("file")) return load_asset(document, options, unit, scene);
  try {
    build_scene(geometry.at("builder").get<std::string>(), geometry.value("parameters", Json::object()),
                scene);
  } catch (const Error& e) {
    throw document.error("/geometry", e.what());
  }
}

// Each override sets factors of the materials whose name it matches; textures still multiply them.
void apply_overrides(const JsonDocument& document, Scene* scene) {
  const Json list = document.root().value("materials", Json::array());
  for (size_t i = 0; i < list.size(); ++i) {
    const Json& o = list[i];
    const std::string pattern = o.at("match").get<std::string>();
    std::vector<std::string> names;
    bool matched = false;
    for (Material& m : scene->materials) {
      names.push_back(m.name);
      if (m.name != pattern && fnmatch(pattern.c_str(), m.name.c_str(), 0) != 0) continue;
      matched = true;
      if (o.contains("base_color")) {
        for (int k = 0; k < 3; ++k) m.base_color[k] = o["base_color"][k].get<float>();
      }
      m.metallic = o.value("metallic", m.metallic);
      m.roughness = o.value("roughness", m.roughness);
      m.phong_exponent = o.value("phong_exponent", m.phong_exponent);
      m.specular = o.value("specular", m.specular);
    }
    if (!matched) {
      throw document.error(fmt::format("/materials/{}/match", i),
                           fmt::format("'{}' matches no material{}", pattern, suggestion(pattern, names)));
    }
  }
}

}  // namespace

SceneName parse_scene_name(const std::string& text) {
  const size_t colon = text.rfind(':'), slash = text.rfind('/');
  if (colon == std::string::npos || (slash != std::string::npos && colon < slash))
    return {text, std::nullopt};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

bool is_path(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(".json");
}

Scene load_scene(const std::string& name_or_path, const SceneOptions& options) {
  const SceneFile wanted = locate(name_or_path, options);
  const JsonDocument document = load_document(wanted.path);
  const Json& root = document.root();
  const std::string view = choose_view(document, wanted.view);
  choose_view(document, "");  // the default view must exist too
  Scene scene;
  scene.name = root.at("name").get<std::string>();
  if (view != root.at("default_view").get<std::string>()) scene.name += ":" + view;

  const double unit = root.value("unit", 1.0);
  if (root.contains("offset")) {
    for (int k = 0; k < 3; ++k) scene.offset[k] = unit * root["offset"][k].get<double>();
  }
  if (root.contains("animation")) {
    scene.animation.frames = options.frames > 0 ? options.frames : root["animation"].value("frames", 16u);
    scene.animation.rate = root["animation"].value("rate", scene.animation.rate);
  }
  const double view_unit = root.value("view_unit", unit);
  load_geometry(document, options, unit, &scene);
  apply_overrides(document, &scene);
  add_objects(document, view_unit, &scene);
  apply_view(document, "/views/" + pointer_token(view), view_unit, &scene);
  check_scene(scene);
  scene.hash = scene_hash(scene);
  return scene;
}

std::vector<SceneInfo> list_scenes(const SceneOptions& options) {
  std::vector<SceneInfo> out;
  for (const std::string& folder : scene_folders(options.scenes_dir)) {
    const JsonDocument document = load_document(options.scenes_dir / folder / "scene.json");
    const Json& root = document.root();
    SceneInfo info;
    info.name = folder;
    info.description = root.at("description").get<std::string>();
    info.default_view = root.at("default_view").get<std::string>();
    info.views = view_names(root);
    if (root.at("geometry").contains("file")) {
      std::error_code ec;
      info.asset = asset_path(document, options);
      info.asset_present = fs::exists(info.asset, ec);
      info.get_it = root.value("get_it", "");
    }
    out.push_back(std::move(info));
  }
  return out;
}

}  // namespace vsglbench
