// Skinned meshes at rest (glTF 2.0, 3.7.3).
#pragma once

#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/mesh.h"

namespace vsglbench {

// Of each joint of a skin, its node's transform to world space at rest times the skin's inverse bind matrix,
// the identity where it has none.
std::vector<glm::dmat4> joint_matrices(const GltfFile& file, int skin,
                                       const std::vector<glm::dmat4>& world_of_joints);

// Moves a primitive's vertices to where its joints put them, by JOINTS_n and WEIGHTS_n; the mesh's own node
// has no say.
void apply_skin(const GltfFile& file, const tinygltf::Primitive& primitive,
                const std::vector<glm::dmat4>& joints, const std::string& what, Mesh* mesh);

}  // namespace vsglbench
