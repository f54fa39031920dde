// The scene.json that a glTF file by itself amounts to: its own cameras and lights, or a view and a spot that
// are found for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "scene/scene.h"

namespace vsglbench {

// Whether a path names a glTF file: it ends in .gltf or .glb, in whatever case.
bool is_model(const std::filesystem::path& path);

// "my model" of /x/my_model.glb as scenes are named: letters, digits, '_', '.' and '-'.
std::string model_name(const std::filesystem::path& path);

struct ModelScene {
  Json json;                       // follows scene.schema.json
  std::vector<std::string> notes;  // where its views come from, and what was added, one line each
};

// Of the file's cameras, each with the first of its lights that shines, and the first camera with each
// further light. Where the file has no camera, or no light, or they bring no indirect light into the picture,
// the default view is a found one (found_view.h); where none of the geometry alone gets any, as of a convex
// object, it gets a floor and two walls. `geometry`: what load_gltf(path, 1) has made. `file`: how the
// scene.json names the model. Error(scene).
ModelScene model_scene(const std::filesystem::path& path, const Scene& geometry, const std::string& file);

}  // namespace vsglbench
