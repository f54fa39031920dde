// Where a texture of a glTF file lies on a mesh.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "scene/gltf_file.h"

namespace vsglbench {

// The set of coordinates that a texture is read at, TEXCOORD_<set>, and the transform of
// KHR_texture_transform: scaled, turned, moved.
struct UvMapping {
  int set = 0;
  glm::dvec2 offset{0}, scale{1};
  double rotation = 0;    // radians, against the clock where v runs down the image
  bool textured = false;  // whether a texture is read there at all
  bool operator==(const UvMapping&) const = default;

  glm::dvec2 operator()(const glm::dvec2& uv) const;
};

// `tex_coord`: the texture's own, which the extension may override. Error(scene) for what is malformed.
UvMapping uv_mapping(const GltfFile& file, int tex_coord, const tinygltf::ExtensionMap& extensions,
                     const std::string& what);

}  // namespace vsglbench
