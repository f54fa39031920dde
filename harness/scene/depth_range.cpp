#include "scene/depth_range.h"

#include <algorithm>
#include <cmath>

namespace vsglbench {
namespace {

constexpr double kWidestAspect = 4;  // of a camera, for its near plane
constexpr double kLeastNear = 1e-4;  // of the scene's diagonal

// Least and greatest depth of the bounds' corners along `direction` from `position`.
glm::dvec2 depth_range(const Scene& scene, const glm::vec3& position, const glm::vec3& direction) {
  glm::dvec2 range(INFINITY, -INFINITY);
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 corner(k & 1 ? scene.bounds_max.x : scene.bounds_min.x,
                            k & 2 ? scene.bounds_max.y : scene.bounds_min.y,
                            k & 4 ? scene.bounds_max.z : scene.bounds_min.z);
    const double depth = glm::dot(corner - glm::dvec3(position), glm::dvec3(direction));
    range = {std::min(range.x, depth), std::max(range.y, depth)};
  }
  return range;
}

float distance_to_box(const glm::vec3& p, const glm::vec3& low, const glm::vec3& high) {
  return glm::length(glm::max(glm::max(low - p, p - high), glm::vec3(0)));
}

// Distance to the nearest bounding box of a triangle, or of an object in any frame: no more than that to the
// nearest triangle of any frame. An object's own triangles lie in its box, so that this stays as it moves.
double clearance(const Scene& scene, const glm::vec3& p) {
  float nearest = INFINITY;
  for (const glm::uvec3& t : scene.triangles) {
    const glm::vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
    nearest = std::min(nearest, distance_to_box(p, glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))));
  }
  for (const MovingObject& object : scene.animation.objects) {
    for (const Extent& box : object.extents)
      nearest = std::min(nearest, distance_to_box(p, box.low, box.high));
  }
  return nearest;
}

// `tan_corner` is the tangent of the angle between the axis and a corner of the frustum: a point in view at
// distance d has depth d cos(angle) at least.
void fit_perspective(const Scene& scene, const glm::vec3& position, const glm::vec3& direction,
                     double tan_corner, float* near, float* far) {
  const double diagonal = std::max(1e-6, static_cast<double>(scene.diagonal()));
  const double cosine = 1 / std::sqrt(1 + tan_corner * tan_corner);
  const double n = std::max(kLeastNear * diagonal, 0.99 * cosine * clearance(scene, position));
  *near = static_cast<float>(n);
  *far = static_cast<float>(std::max(1.01 * depth_range(scene, position, direction).y, 2 * n));
}

}  // namespace

void fit_camera_depth(Scene* scene) {
  Camera& camera = scene->camera;
  const double tan_half = std::tan(0.5 * camera.vfov);
  fit_perspective(*scene, camera.position, camera.direction, tan_half * std::hypot(1, kWidestAspect),
                  &camera.near, &camera.far);
}

void fit_light_depth(Scene* scene) {
  Light& light = scene->light;
  if (light.type == Light::Type::spot) {
    fit_perspective(*scene, light.position, light.direction, std::sqrt(2) * std::tan(0.5 * light.fov),
                    &light.near, &light.far);
    return;
  }
  const double margin = std::max(1e-6, 0.01 * scene->diagonal());
  const glm::dvec2 range = depth_range(*scene, light.position, light.direction);
  light.position += static_cast<float>(range.x - margin) * light.direction;
  light.near = static_cast<float>(0.5 * margin);
  light.far = static_cast<float>(range.y - range.x + 2 * margin);
}

void fit_depth_ranges(Scene* scene) {
  fit_camera_depth(scene);
  fit_light_depth(scene);
}

}  // namespace vsglbench
