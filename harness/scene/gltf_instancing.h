// Meshes that a node repeats: the extension EXT_mesh_gpu_instancing.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/gltf_file.h"

namespace vsglbench {

// Where each instance stands in its node; nothing of a node that does not repeat its mesh. Error(scene) for
// what is malformed.
std::optional<std::vector<glm::dmat4>> instance_transforms(const GltfFile& file, const tinygltf::Node& node,
                                                           int index);

}  // namespace vsglbench
