// The plane a light or a camera projects onto: the one place that maps directions to texels.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace vsglbench {

// Orthonormal view frame and extents. Image coordinates (u,v) in [0,1]^2, (0,0) top left: u grows along
// `right`, v grows against `up`.
struct View {
  bool perspective = true;
  glm::vec3 position{0}, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  glm::vec2 extent{1, 1};  // perspective: tan of the half angles; orthographic: half sizes in metres
  float near = 0.01f, far = 1000;

  // Vulkan clip space, y down, depth 0…1. Column-major.
  glm::mat4 view_projection() const;
  // (u,v) of a point; nothing when it lies outside the frustum's sides or behind (near/far are ignored).
  std::optional<glm::vec2> project(const glm::vec3& point) const;
  // Ray through (u,v): origin and unit direction.
  void ray(const glm::vec2& uv, glm::vec3* origin, glm::vec3* direction) const;
  // d(u,v)/dA: image area per unit of surface area at `point` with unit normal `normal`; 0 outside.
  double image_density(const glm::vec3& point, const glm::vec3& normal) const;
};

View light_view(const Light& light);
View camera_view(const Camera& camera, uint32_t width, uint32_t height);

// Flux (W) per unit of (u,v) area at (u,v) [light-transport §1]: spot I (2 tan(fov/2))^2 cos^3; directional
// E times the rectangle's area. Integrates to the light's flux inside its frustum.
glm::dvec3 flux_density(const Light& light, const glm::vec2& uv);
// The exact integral of flux_density: spot I * solid angle of the square frustum; directional E * area.
glm::dvec3 frustum_flux(const Light& light);

}  // namespace vsglbench
