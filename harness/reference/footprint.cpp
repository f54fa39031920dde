#include "reference/footprint.h"

#include <algorithm>
#include <cmath>

#include "reference/random.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

constexpr uint32_t kStrata = 6;

// A primary ray's hit: point, and unit normal towards the eye.
struct PrimaryHit {
  glm::vec3 point, normal;
};

PrimaryHit locate(const Hit& hit, const glm::vec3& origin, const glm::vec3& direction) {
  const glm::vec3 normal = glm::normalize(hit.face_normal);
  return {origin + hit.distance * direction, glm::dot(normal, direction) > 0 ? -normal : normal};
}

// Fraction of the pixel whose primary rays meet the surface at its centre; at least one ray counts.
float coverage(const Footprint& footprint, uint32_t centre_triangle, const ImagePlane& camera,
               const glm::vec2& corner, const glm::vec2& size, const glm::uvec2& stream, uint64_t seed,
               RayStream& rays) {
  uint32_t same = 0;
  for (uint32_t s = 0; s < kStrata * kStrata; ++s) {
    const glm::vec2 jitter(random4(seed, Stream::footprint, stream.y * kStrata * kStrata + s, stream.x));
    const glm::vec2 cell(s % kStrata, s / kStrata);
    glm::vec3 origin, direction;
    camera.view().ray(corner + size * (cell + jitter) / float(kStrata), &origin, &direction);
    const auto hit = rays.intersect(origin, direction);
    if (!hit) continue;
    if (hit->triangle == centre_triangle) {
      ++same;
      continue;
    }
    const PrimaryHit primary = locate(*hit, origin, direction);
    same += footprint.same_surface(primary.point, primary.normal);
  }
  return static_cast<float>(std::max(same, 1u)) / (kStrata * kStrata);
}

}  // namespace

Footprint trace_footprint(const ImagePlane& camera, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                          uint64_t seed, RayStream& rays) {
  Footprint footprint;
  const glm::vec2 size(1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height));
  const glm::vec2 centre = (glm::vec2(x, y) + 0.5f) * size;
  glm::vec3 eye, direction;
  camera.view().ray(centre, &eye, &direction);
  const auto hit = rays.intersect(eye, direction);
  if (!hit) return footprint;

  // The surface at the centre.
  const glm::vec3 to_eye = -direction;
  const Surface surface = surface_at(rays.tracer().scene(), hit->triangle, hit->barycentric, to_eye);
  footprint.valid = true;
  footprint.position = surface.position;
  footprint.ray_origin = rays.tracer().offset(surface.position, surface.geometric_normal);
  footprint.brdf = Brdf(surface, to_eye);

  // Its extent: half a pixel's width at this depth is the tolerance across the tangent plane.
  const float facing = camera.facing_density(-to_eye, glm::distance(eye, surface.position));
  const auto pixels = static_cast<float>(width) * static_cast<float>(height);
  footprint.plane_tolerance = 0.5f / std::sqrt(facing * pixels) + rays.tracer().epsilon(surface.position);
  const glm::vec2 corner = glm::vec2(x, y) * size;
  footprint.uv_density =
      pixels / coverage(footprint, hit->triangle, camera, corner, size, {x, y}, seed, rays);
  footprint.kernel = facing * std::abs(glm::dot(surface.geometric_normal, to_eye)) * footprint.uv_density;
  return footprint;
}

}  // namespace vsglbench
