// What each pixel of the reference sees: the surface at its centre (x2), and how much of the pixel's area
// the same surface fills.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/brdf.h"
#include "reference/image_plane.h"
#include "reference/ray_stream.h"

namespace vsglbench {

struct Footprint {
  bool valid = false;  // false: the ray through the pixel's centre hits nothing
  uint32_t tile = 0;   // of the LightGuide
  glm::vec3 position{0};
  glm::vec3 ray_origin{0};    // `position`, moved off the surface towards the eye
  Brdf brdf;                  // and the normals, towards the eye
  float plane_tolerance = 0;  // metres off the tangent plane that still count as this surface
  float uv_density = 0;       // 1 / (u,v) area of the part of the pixel that sees this surface
  float kernel = 0;           // 1/m^2 at the centre: 1 / area of that part on the surface

  // Whether a point, with unit normal towards the eye, lies on the surface seen at the centre.
  bool same_surface(const glm::vec3& point, const glm::vec3& point_normal) const {
    const glm::vec3& normal = brdf.geometric_normal();
    return std::abs(glm::dot(normal, point - position)) <= plane_tolerance &&
           glm::dot(normal, point_normal) >= 0.9f;
  }
};

// Traces the centre of pixel (x, y) and, stratified and jittered by `seed`, 6x6 rays over its area.
Footprint trace_footprint(const ImagePlane& camera, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                          uint64_t seed, RayStream& rays);

}  // namespace vsglbench
