// Scenes made by code: nothing to download, and the same arrays on every machine.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "scene/scene.h"

namespace vsglbench {

// Fills geometry, materials and textures; reads its parameters from `parameters` (an object, possibly
// empty), where an unknown key or a value out of range is an Error(scene) that names it.
using SceneBuilder = void (*)(const Json& parameters, Scene* scene);

struct BuilderEntry {
  std::string name;
  SceneBuilder build;
};

// In the order they are listed to the user.
const std::vector<BuilderEntry>& scene_builders();

// Throws Error(scene), naming the nearest builder, when there is no such one.
void build_scene(const std::string& builder, const Json& parameters, Scene* scene);

void build_cornell(const Json& parameters, Scene* scene);
void build_ring(const Json& parameters, Scene* scene);
void build_colonnade(const Json& parameters, Scene* scene);

}  // namespace vsglbench
