// Densities on the image plane of a light or camera in single precision, for the inner loops. The same
// functions as scene/view.h, which defines them (image_plane_test.cpp holds the two together).
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/view.h"

namespace vsglbench {

class ImagePlane {
 public:
  explicit ImagePlane(const View& view)
      : view_(view), area_(4 * view.extent.x * view.extent.y), inverse_extent_(0.5f / view.extent) {}

  const View& view() const { return view_; }

  // (u,v) of a point in front of the plane's origin and inside the frustum's sides.
  std::optional<glm::vec2> project(const glm::vec3& point) const {
    const glm::vec3 d = point - view_.position;
    const float z = glm::dot(d, view_.forward);
    if (!(z > 0)) return std::nullopt;
    const float scale = view_.perspective ? 1 / z : 1;
    const float u = 0.5f + glm::dot(d, view_.right) * scale * inverse_extent_.x;
    const float v = 0.5f - glm::dot(d, view_.up) * scale * inverse_extent_.y;
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) return std::nullopt;
    return glm::vec2(u, v);
  }

  // Where the plane's ray to `point` starts.
  glm::vec3 origin(const glm::vec3& point) const {
    if (view_.perspective) return view_.position;
    return point - glm::dot(point - view_.position, view_.forward) * view_.forward;
  }

  // d(u,v)/dA for a surface that faces the ray: times the cosine it is View::image_density. 1/m^2.
  float facing_density(const glm::vec3& direction, float distance) const {
    if (!view_.perspective) return 1 / area_;
    const float c = glm::dot(direction, view_.forward);
    return 1 / (distance * distance * c * c * c * area_);
  }

 private:
  View view_;
  float area_;  // of the plane at distance 1, or in m^2
  glm::vec2 inverse_extent_;
};

}  // namespace vsglbench
