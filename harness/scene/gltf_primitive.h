// One primitive of a glTF mesh as triangles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/gltf_uv.h"
#include "scene/mesh.h"

namespace vsglbench {

struct GltfPrimitive {
  Mesh mesh;              // empty tangents are made later
  uint32_t material = 0;  // of the scene; behind the file's own stands the default one
  bool skinned = false;   // then the mesh stands in world space already
};

// `uvs`: of each material of the scene, how its textures lie on a mesh. `joints`: of a skinned mesh, what
// takes each joint's space to the world; empty of others. Nothing for points and lines. Warns of what is
// ignored or repaired; Error(scene) for what is malformed.
std::optional<GltfPrimitive> read_primitive(GltfFile* file, const tinygltf::Primitive& from,
                                            const std::vector<UvMapping>& uvs,
                                            const std::vector<glm::dmat4>& joints, const std::string& what);

// Turns every triangle over, for a transform that mirrors.
void turn_over(Mesh* mesh);

}  // namespace vsglbench
