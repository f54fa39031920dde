#include "scene/scene_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench {
namespace {

constexpr double kWidestAspect = 4;      // of a camera, for its near plane
constexpr double kLeastNear = 1e-4;      // of the scene's diagonal
constexpr double kLargestLength = 1e15;  // metres; keeps squares finite in float

class ViewReader {
 public:
  ViewReader(const JsonDocument& document, double unit, Scene* scene)
      : document_(document), unit_(unit), scene_(scene) {}

  void camera(const std::string& at) {
    Camera& camera = scene_->camera;
    camera.position = point(at + "/eye");
    frame(at, "/eye", &camera.direction, &camera.up);
    camera.vfov = radians(at + "/vfov");
  }

  void light(const std::string& at) {
    const Json& json = value(at);
    if (json.size() != 1) throw document_.error(at, "must hold one light, either 'spot' or 'sun'");
    json.contains("spot") ? spot(at + "/spot") : sun(at + "/sun");
  }

 private:
  const Json& value(const std::string& at) const { return document_.root().at(Json::json_pointer(at)); }
  bool has(const std::string& at) const { return document_.root().contains(Json::json_pointer(at)); }

  glm::dvec3 vector(const std::string& at) const {
    const Json& v = value(at);
    const glm::dvec3 out(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
    if (!(glm::length(out) * unit_ < kLargestLength)) throw document_.error(at, "is too large");
    return out;
  }
  glm::vec3 point(const std::string& at) const {
    return glm::vec3(unit_ * vector(at) + scene_->offset - scene_->origin);
  }
  float radians(const std::string& at) const {
    return static_cast<float>(value(at).get<double>() * std::numbers::pi / 180);
  }

  glm::vec3 power(const std::string& at, double scale) const {
    const Json& v = value(at);
    const glm::dvec3 p = v.is_number() ? glm::dvec3(v.get<double>()) : vector(at);
    if (!(scale * std::max({p.x, p.y, p.z}) < 1e30)) throw document_.error(at, "is too large");
    return glm::vec3(scale * p);
  }

  glm::dvec3 direction(const std::string& at, const std::string& position) const {
    const bool given = has(at + "/direction"), aimed = has(at + "/target");
    if (given == aimed) throw document_.error(at, "must have either 'direction' or 'target'");
    const glm::dvec3 d = given ? vector(at + "/direction") : vector(at + "/target") - vector(at + position);
    if (!(glm::length(d) > 0)) {
      throw document_.error(at + (given ? "/direction" : "/target"),
                            given ? "has no length" : "is where it looks from");
    }
    return glm::normalize(d);
  }

  // Unit direction, and up made orthogonal to it; another up where the wanted one is parallel.
  void frame(const std::string& at, const std::string& position, glm::vec3* out_direction,
             glm::vec3* out_up) {
    const glm::dvec3 d = direction(at, position);
    glm::dvec3 up = has(at + "/up") ? vector(at + "/up") : glm::dvec3(0, 1, 0);
    if (!(glm::length(up) > 0)) throw document_.error(at + "/up", "has no length");
    up = glm::normalize(up);
    for (const glm::dvec3& other : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)}) {
      if (glm::length(glm::cross(d, up)) < 1e-3) up = other;
    }
    const glm::dvec3 right = glm::normalize(glm::cross(d, up));
    *out_direction = glm::vec3(d);
    *out_up = glm::vec3(glm::cross(right, d));
  }

  void spot(const std::string& at) {
    Light& light = scene_->light;
    light.type = Light::Type::spot;
    light.position = point(at + "/position");
    frame(at, "/position", &light.direction, &light.up);
    light.fov = radians(at + "/fov");
    // E = I/d^2 must not depend on the unit of d.
    light.power = power(at + "/intensity", unit_ * unit_);
  }

  void sun(const std::string& at) {
    Light& light = scene_->light;
    light.type = Light::Type::directional;
    frame(at, "", &light.direction, &light.up);
    light.power = power(at + "/irradiance", 1);
    if (has(at + "/centre") != has(at + "/half_extent")) {
      throw document_.error(at, "must have both 'centre' and 'half_extent', or neither");
    }
    if (!has(at + "/centre")) return fit_rectangle(&light);
    light.position = point(at + "/centre");
    const Json& half = value(at + "/half_extent");
    const glm::dvec2 extent(half[0].get<double>() * unit_, half[1].get<double>() * unit_);
    if (!(extent.x > 0 && extent.y > 0 && glm::length(extent) < kLargestLength)) {
      throw document_.error(at + "/half_extent", "must be positive");
    }
    light.half_extent = glm::vec2(extent);
  }

  // The smallest rectangle, in the light's frame, that covers all triangles.
  void fit_rectangle(Light* light) const {
    const glm::vec3 right = glm::cross(light->direction, light->up);
    glm::vec2 low(INFINITY), high(-INFINITY);
    for (const glm::uvec3& t : scene_->triangles) {
      for (const uint32_t i : {t.x, t.y, t.z}) {
        const glm::vec2 p(glm::dot(scene_->positions[i], right), glm::dot(scene_->positions[i], light->up));
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    const glm::vec2 centre = 0.5f * (low + high);
    light->position = centre.x * right + centre.y * light->up;
    light->half_extent = glm::max(0.5f * (high - low) * 1.001f, glm::vec2(1e-6f));
  }

  const JsonDocument& document_;
  double unit_;
  Scene* scene_;
};

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

// Distance to the nearest bounding box of a triangle: no more than that to the nearest triangle.
double clearance(const Scene& scene, const glm::vec3& p) {
  float nearest = INFINITY;
  for (const glm::uvec3& t : scene.triangles) {
    const glm::vec3 &a = scene.positions[t.x], &b = scene.positions[t.y], &c = scene.positions[t.z];
    const glm::vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    nearest = std::min(nearest, glm::length(glm::max(glm::max(low - p, p - high), glm::vec3(0))));
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

void apply_view(const JsonDocument& document, const std::string& pointer, double unit, Scene* scene) {
  ViewReader reader(document, unit, scene);
  reader.camera(pointer + "/camera");
  reader.light(pointer + "/light");
  fit_depth_ranges(scene);
}

void fit_depth_ranges(Scene* scene) {
  Camera& camera = scene->camera;
  const double tan_half = std::tan(0.5 * camera.vfov);
  fit_perspective(*scene, camera.position, camera.direction, tan_half * std::hypot(1, kWidestAspect),
                  &camera.near, &camera.far);
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

}  // namespace vsglbench
