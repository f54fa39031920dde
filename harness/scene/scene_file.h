// scene.json: geometry, materials, one light and one camera a view. Documented in scenes/README.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace vsglbench {

struct SceneOptions {
  std::filesystem::path scenes_dir;  // holds NAME/scene.json
  std::filesystem::path assets_dir;  // where downloaded geometry lies; may be empty
  uint32_t frames = 0;               // of a scene with `animation`, in place of its own number; 0: its own
};

// "colonnade:cut" in its parts: a colon after the last slash parts the view off.
struct SceneName {
  std::string scene;                // "colonnade", or a path
  std::optional<std::string> view;  // nothing: the default one
};
SceneName parse_scene_name(const std::string& text);

// Whether a name is the path of a file or folder: it has a '/' or ends in .json, .gltf or .glb.
bool is_path(const std::string& name);

// `name_or_path`: "sponza"; a scene.json or its folder; or a glTF file, for the scene.json that model_scene()
// makes of it; each may end in ":VIEW". Without one the default view. The scene comes checked, hashed, and in
// frame 0; set_frame() poses it in others. Throws Error(asset_missing) for geometry that isn't here, with
// where to get it; Error(scene) "FILE:LINE: ...", ErrorList where a scene.json has several faults.
Scene load_scene(const std::string& name_or_path, const SceneOptions& options);

// What a list of scenes shows, read without loading geometry.
struct SceneInfo {
  std::string name, description, default_view;
  std::vector<std::string> views;
  std::filesystem::path asset;  // the geometry file; empty for a scene that is built by code
  bool asset_present = true;
  std::string get_it;  // where to get the asset
};

// All scenes of scenes_dir, by name. Throws Error(scene) for one that can't be read.
std::vector<SceneInfo> list_scenes(const SceneOptions& options);

}  // namespace vsglbench
