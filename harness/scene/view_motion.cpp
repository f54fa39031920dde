#include "scene/view_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "scene/animation.h"

namespace vsglbench {
namespace {

constexpr double kLargestLength = 1e15;  // metres; keeps squares finite in float
constexpr double kLargestPower = 1e30;

template <class... Args>
void require(bool condition, fmt::format_string<Args...> format, Args&&... args) {
  if (!condition) throw fail(ErrorKind::scene, format, std::forward<Args>(args)...);
}

struct Axes {
  glm::vec3 direction, up;  // unit, orthogonal
};

// Up is made orthogonal; another one is taken where the wanted one is parallel.
Axes axes_at(const AimMotion& motion, double time) {
  const glm::dvec3 aim = motion.aim.at(time);
  glm::dvec3 d = motion.at_target ? aim - motion.position.at(time) : aim;
  require(glm::length(d) > 0 && std::isfinite(glm::length(d)), "it looks nowhere: {}",
          motion.at_target ? "its target is where it stands" : "its direction has no length");
  d = glm::normalize(d);
  glm::dvec3 up = motion.up.at(time);
  require(glm::length(up) > 0 && std::isfinite(glm::length(up)), "its up has no length");
  up = glm::normalize(up);
  for (const glm::dvec3& other : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)}) {
    if (glm::length(glm::cross(d, up)) < 1e-3) up = other;
  }
  const glm::dvec3 right = glm::normalize(glm::cross(d, up));
  return {glm::vec3(d), glm::vec3(glm::cross(right, d))};
}

glm::vec3 position_at(const AimMotion& motion, const Scene& scene, double time) {
  const glm::dvec3 p = motion.unit * motion.position.at(time);
  require(glm::length(p) < kLargestLength, "it stands too far off");
  return glm::vec3(p + scene.offset - scene.origin);
}

float angle_at(const Track<double>& degrees, double time) {
  const double angle = degrees.at(time);
  require(angle > 0 && angle < 180, "its angle is {} degrees, outside 0…180", angle);
  return static_cast<float>(angle * std::numbers::pi / 180);
}

glm::vec3 power_at(const LightMotion& motion, double time) {
  // E = I/d^2 must not depend on the unit of d.
  const double scale = motion.sun ? 1 : motion.aim.unit * motion.aim.unit;
  const glm::dvec3 power = motion.power.at(time);
  require(power.x >= 0 && power.y >= 0 && power.z >= 0, "its power is negative");
  require(scale * std::max({power.x, power.y, power.z}) < kLargestPower, "its power is too large");
  return glm::vec3(scale * power);
}

// The smallest rectangle, in the light's frame, that covers all triangles that stand still.
void fit_rectangle(const Scene& scene, Light* light) {
  const glm::vec3 right = glm::cross(light->direction, light->up);
  glm::vec2 low(INFINITY), high(-INFINITY);
  const size_t still = still_triangles(scene), count = still > 0 ? still : scene.triangles.size();
  for (size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& vertex = scene.positions[scene.triangles[i][k]];
      const glm::vec2 p(glm::dot(vertex, right), glm::dot(vertex, light->up));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const glm::vec2 centre = 0.5f * (low + high);
  light->position = centre.x * right + centre.y * light->up;
  light->half_extent = glm::max(0.5f * (high - low) * 1.001f, glm::vec2(1e-6f));
}

}  // namespace

Camera posed(const CameraMotion& motion, const Scene& scene, double time) {
  Camera camera = scene.camera;
  const Axes axes = axes_at(motion.aim, time);
  camera.position = position_at(motion.aim, scene, time);
  camera.direction = axes.direction;
  camera.up = axes.up;
  camera.vfov = angle_at(motion.vfov, time);
  return camera;
}

Light posed(const LightMotion& motion, const Scene& scene, double time) {
  Light light = scene.light;
  light.type = motion.sun ? Light::Type::directional : Light::Type::spot;
  const Axes axes = axes_at(motion.aim, time);
  light.direction = axes.direction;
  light.up = axes.up;
  light.power = power_at(motion, time);
  if (!motion.sun) {
    light.position = position_at(motion.aim, scene, time);
    light.fov = angle_at(motion.fov, time);
  } else if (motion.half_extent) {
    light.position = position_at(motion.aim, scene, time);
    light.half_extent = glm::vec2(*motion.half_extent * motion.aim.unit);
  } else {
    fit_rectangle(scene, &light);
  }
  return light;
}

}  // namespace vsglbench
