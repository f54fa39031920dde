#include "scene/scene_file.h"

#include <fnmatch.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "base/file.h"
#include "base/json.h"
#include "base/nearest.h"
#include "scene/builders.h"
#include "scene/check.h"
#include "scene/gltf.h"
#include "scene/model_scene.h"
#include "scene/scene_objects.h"
#include "scene/scene_problems.h"
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

const Json& scene_schema() {
  static const Json schema =
      JsonDocument::load(data_root() / "harness" / "scene" / "scene.schema.json", ErrorKind::scene).root();
  return schema;
}

// A file or a builder, and only what is for it.
void check_geometry(SceneProblems* problems) {
  const JsonDocument& document = problems->document();
  problems->check("/geometry", [&](const std::string& at) {
    const Json& geometry = document.root().at("geometry");
    if (geometry.contains("file") == geometry.contains("builder"))
      throw document.error(at, "must have either 'file' or 'builder'");
    if (geometry.contains("file") && geometry.contains("parameters"))
      throw document.error(at + "/parameters", "is for a builder, not for a file");
    for (const char* key : {"unit", "view_unit"}) {
      if (geometry.contains("builder") && document.root().contains(key))
        throw document.error(std::string("/") + key, "is for a file; builders use metres");
    }
  });
}

std::vector<std::string> view_names(const Json& root) {
  std::vector<std::string> names;
  if (!root.value("views", Json()).is_object()) return names;
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
void apply_override(const JsonDocument& document, const std::string& at, Scene* scene) {
  const Json& o = document.root().at(Json::json_pointer(at));
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
    throw document.error(at + "/match",
                         fmt::format("'{}' matches no material{}", pattern, suggestion(pattern, names)));
  }
}

void apply_overrides(SceneProblems* problems, Scene* scene) {
  const JsonDocument& document = problems->document();
  const Json list = document.root().value("materials", Json());
  for (size_t i = 0; list.is_array() && i < list.size(); ++i)
    problems->check(fmt::format("/materials/{}", i),
                    [&](const std::string& at) { apply_override(document, at, scene); });
}

// What `about` says of the file was true once.
void check_about(const Json& root, Scene* scene) {
  const Json about = root.value("about", Json::object());
  const size_t now = scene->triangles.size(), then = about.value("triangles", now);
  if (now != then)
    scene->warnings.push_back(
        fmt::format("its file has {} triangles, and had {} when 'about' was written", now, then));
}

double number(const SceneProblems& problems, const std::string& key, double standard) {
  return problems.sound("/" + key) ? problems.document().root().at(key).get<double>() : standard;
}

// All of a document but the geometry, which `load` brings into a scene whose offset and animation are set.
Scene scene_of(const JsonDocument& document, const std::string& wanted_view, const SceneOptions& options,
               const std::function<void(double unit, Scene*)>& load) {
  SceneProblems problems(document, scene_schema());
  const Json& root = document.root();
  if (!root.is_object()) problems.raise();
  check_geometry(&problems);
  const double unit = number(problems, "unit", 1), view_unit = number(problems, "view_unit", unit);
  std::string view;
  problems.check("/default_view", [&](const std::string&) { choose_view(document, ""); });
  if (problems.sound("/default_view"))
    problems.check("/views", [&](const std::string&) { view = choose_view(document, wanted_view); });
  for (const std::string& name : view_names(root))
    check_view("/views/" + pointer_token(name), view_unit, &problems);
  check_objects(&problems);

  Scene scene;
  if (problems.sound("/offset")) {
    for (int k = 0; k < 3; ++k) scene.offset[k] = unit * root["offset"][k].get<double>();
  }
  if (problems.sound("/animation")) {
    scene.animation.frames = options.frames > 0 ? options.frames : root["animation"].value("frames", 16u);
    scene.animation.rate = root["animation"].value("rate", scene.animation.rate);
  }
  std::optional<Error> absent;  // is no fault of the file
  problems.check("/geometry", [&](const std::string&) {
    try {
      load(unit, &scene);
      apply_overrides(&problems, &scene);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::asset_missing) throw;
      absent = e;
    }
  });
  problems.raise();
  if (absent) throw Error(*absent);
  scene.name = root.at("name").get<std::string>();
  if (view != root.at("default_view").get<std::string>()) scene.name += ":" + view;
  check_about(root, &scene);
  add_objects(document, view_unit, &scene);
  apply_view(document, "/views/" + pointer_token(view), view_unit, &scene);
  check_scene(scene);
  scene.hash = scene_hash(scene);
  return scene;
}

// A glTF file by itself, through the scene.json that it amounts to: written by new-scene, that is the same
// scene.
Scene load_model(const SceneFile& wanted, const SceneOptions& options) {
  Scene geometry;
  load_gltf(wanted.path, 1, &geometry);
  const ModelScene made = model_scene(wanted.path, geometry, wanted.path.filename().string());
  const JsonDocument document =
      JsonDocument::parse(made.json.dump(2), wanted.path.string(), ErrorKind::scene);
  const auto take = [&](double, Scene* scene) { *scene = std::move(geometry); };
  Scene scene = scene_of(document, wanted.view, options, take);
  // The notes say what became of the file's cameras and lights, which its geometry alone has no use for.
  std::erase_if(scene.warnings, [](const std::string& warning) {
    return warning.find("its cameras are not used") != std::string::npos ||
           warning.find("KHR_lights_punctual is ignored") != std::string::npos;
  });
  scene.warnings.insert(scene.warnings.end(), made.notes.begin(), made.notes.end());
  return scene;
}

}  // namespace

SceneName parse_scene_name(const std::string& text) {
  const size_t colon = text.rfind(':'), slash = text.rfind('/');
  if (colon == std::string::npos || (slash != std::string::npos && colon < slash))
    return {text, std::nullopt};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

bool is_path(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(".json") || is_model(name);
}

Scene load_scene(const std::string& name_or_path, const SceneOptions& options) {
  const SceneFile wanted = locate(name_or_path, options);
  if (is_model(wanted.path)) return load_model(wanted, options);
  const JsonDocument document = JsonDocument::load(wanted.path, ErrorKind::scene);
  return scene_of(document, wanted.view, options,
                  [&](double unit, Scene* scene) { load_geometry(document, options, unit, scene); });
}

std::vector<SceneInfo> list_scenes(const SceneOptions& options) {
  std::vector<SceneInfo> out;
  for (const std::string& folder : scene_folders(options.scenes_dir)) {
    const JsonDocument document =
        JsonDocument::load(options.scenes_dir / folder / "scene.json", ErrorKind::scene);
    SceneProblems problems(document, scene_schema());
    check_geometry(&problems);
    problems.raise();
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
