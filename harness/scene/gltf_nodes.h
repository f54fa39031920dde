// The node hierarchy of a glTF file.
#pragma once

#include <optional>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/motion.h"

namespace vsglbench {

struct GltfInstance {
  int mesh;
  glm::dmat4 transform;            // to world space, of what stands still
  std::optional<uint32_t> node;    // of Animation::nodes: what moves
  std::vector<glm::dmat4> joints;  // of a skinned mesh: from its vertices to world space, by joint, at rest
};

// Of a node in its parent. Error(scene) for a matrix or part that is none.
glm::dmat4 local_transform(const GltfFile& file, const tinygltf::Node& node, int index);
// Of the default scene (gltf.h says which that is).
std::vector<int> root_nodes(const GltfFile& file);

// All meshes of the default scene's hierarchy (gltf.h says which that is) in depth-first order. A node that
// is reached twice (a cycle, or two parents) is an error; what EXT_mesh_gpu_instancing repeats is listed as
// often. Where `animation` has frames, nodes that the file animates and all below them are added to its
// nodes; a skin that they move is an error, since skins stand at rest. Without frames nothing moves, and a
// warning says so.
std::vector<GltfInstance> gltf_instances(GltfFile* file, Animation* animation);

}  // namespace vsglbench
