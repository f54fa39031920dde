// The one definition of a surface point, on the host: what the G-buffer's fragment shader computes too.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace vsglbench {

struct Surface {
  glm::vec3 position{0};
  glm::vec3 geometric_normal{0};  // unit, of the face, turned towards the viewer
  glm::vec3 normal{0};            // unit, shading, see surface_at
  glm::vec3 diffuse{0};           // Rd
  glm::vec3 f0{0};                // F0
  float ndf = 1;                  // > 0: GGX alpha; < 0: minus the Phong exponent
};

// Bilinear, repeating, finest level; sRGB decoded before filtering. Returns RGBA in [0,1].
glm::vec4 sample_texture(const Texture& texture, const glm::vec2& uv);

// Alpha test at barycentrics (u,v) (weights of the triangle's second and third vertex): true = a hole.
bool is_hole(const Scene& scene, uint32_t triangle, const glm::vec2& barycentric);

// The surface at barycentrics (u,v) of a triangle, seen from the direction `to_viewer` (unit, away from the
// surface). Shading normal: interpolated, normal-mapped (glTF tangent space, times normal_scale in xy),
// turned over as a whole if it points away from the geometric normal, and, where its cosine with
// `to_viewer` is below 0.01, bent towards the viewer: n = normalize(n + (0.01 - n.v) v).
Surface surface_at(const Scene& scene, uint32_t triangle, const glm::vec2& barycentric,
                   const glm::vec3& to_viewer);

}  // namespace vsglbench
