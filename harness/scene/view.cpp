#include "scene/view.h"

#include <cmath>

namespace vsglbench {

glm::mat4 View::view_projection() const {
  const glm::mat4 rotation(glm::vec4(right.x, up.x, forward.x, 0), glm::vec4(right.y, up.y, forward.y, 0),
                           glm::vec4(right.z, up.z, forward.z, 0), glm::vec4(0, 0, 0, 1));
  glm::mat4 translation(1);
  translation[3] = glm::vec4(-position, 1);
  glm::mat4 projection(0);
  projection[0][0] = 1 / extent.x;
  projection[1][1] = -1 / extent.y;  // Vulkan's clip-space y points down
  if (perspective) {
    projection[2][2] = far / (far - near);
    projection[2][3] = 1;
    projection[3][2] = -near * far / (far - near);
  } else {
    projection[2][2] = 1 / (far - near);
    projection[3][2] = -near / (far - near);
    projection[3][3] = 1;
  }
  return projection * rotation * translation;
}

std::optional<glm::vec2> View::project(const glm::vec3& point) const {
  const glm::dvec3 d = glm::dvec3(point) - glm::dvec3(position);
  const double z = glm::dot(d, glm::dvec3(forward));
  if (perspective && !(z > 0)) return std::nullopt;
  const double scale = perspective ? z : 1.0;
  const double x = glm::dot(d, glm::dvec3(right)) / (scale * extent.x);
  const double y = glm::dot(d, glm::dvec3(up)) / (scale * extent.y);
  if (!(std::abs(x) <= 1 && std::abs(y) <= 1)) return std::nullopt;
  return glm::vec2(0.5 + 0.5 * x, 0.5 - 0.5 * y);
}

void View::ray(const glm::vec2& uv, glm::vec3* origin, glm::vec3* direction) const {
  const float x = (2 * uv.x - 1) * extent.x, y = (1 - 2 * uv.y) * extent.y;
  if (perspective) {
    *origin = position;
    *direction = glm::normalize(forward + x * right + y * up);
  } else {
    *origin = position + x * right + y * up;
    *direction = forward;
  }
}

double View::image_density(const glm::vec3& point, const glm::vec3& normal) const {
  if (!project(point)) return 0;
  const glm::dvec3 d = glm::dvec3(point) - glm::dvec3(position);
  const double plane = 4.0 * extent.x * extent.y;  // area of the image plane at distance 1 (or in metres)
  if (!perspective) return std::abs(glm::dot(glm::dvec3(normal), glm::dvec3(forward))) / plane;
  const double distance = glm::length(d);
  const double cos_plane = glm::dot(d, glm::dvec3(forward)) / distance;
  const double cos_surface = std::abs(glm::dot(d, glm::dvec3(normal))) / distance;
  return cos_surface / (distance * distance * cos_plane * cos_plane * cos_plane * plane);
}

namespace {

View make_view(const glm::vec3& position, const glm::vec3& direction, const glm::vec3& up) {
  View view;
  view.position = position;
  view.forward = glm::normalize(direction);
  view.right = glm::normalize(glm::cross(view.forward, up));
  view.up = glm::cross(view.right, view.forward);
  return view;
}

}  // namespace

View light_view(const Light& light) {
  View view = make_view(light.position, light.direction, light.up);
  view.perspective = light.type == Light::Type::spot;
  view.extent = view.perspective ? glm::vec2(std::tan(0.5f * light.fov)) : light.half_extent;
  view.near = light.near;
  view.far = light.far;
  return view;
}

View camera_view(const Camera& camera, uint32_t width, uint32_t height) {
  View view = make_view(camera.position, camera.direction, camera.up);
  const float tan_half = std::tan(0.5f * camera.vfov);
  view.extent = {tan_half * static_cast<float>(width) / static_cast<float>(height), tan_half};
  view.near = camera.near;
  view.far = camera.far;
  return view;
}

glm::dvec3 flux_density(const Light& light, const glm::vec2& uv) {
  if (light.type == Light::Type::directional) {
    return glm::dvec3(light.power) * (4.0 * light.half_extent.x * light.half_extent.y);
  }
  const double t = std::tan(0.5 * light.fov);
  const double x = (2.0 * uv.x - 1) * t, y = (1 - 2.0 * uv.y) * t;
  const double cos_theta = 1 / std::sqrt(1 + x * x + y * y);
  return glm::dvec3(light.power) * (4 * t * t * cos_theta * cos_theta * cos_theta);
}

glm::dvec3 frustum_flux(const Light& light) {
  if (light.type == Light::Type::directional) return flux_density(light, {0.5f, 0.5f});
  // Solid angle of a right square pyramid with half angle fov/2: 4 asin(sin^2(fov/2)).
  const double s = std::sin(0.5 * light.fov);
  return glm::dvec3(light.power) * (4 * std::asin(s * s));
}

}  // namespace vsglbench
