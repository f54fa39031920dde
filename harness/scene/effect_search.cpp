#include "scene/effect_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "scene/surface.h"
#include "scene/view.h"

namespace vsglbench {
namespace {

// The planes that bound what a view projects; a point is inside where all are at least 0. As in
// View::project(), there is no near or far plane.
class Frustum {
 public:
  explicit Frustum(const View& view) : view_(view) {}

  // False only where all corners are outside of one plane, by more than rounding: then no point of the
  // triangle is inside.
  bool may_hold(const Scene& scene, const glm::uvec3& t) const {
    std::array<int, 5> outside{};
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 d = glm::dvec3(scene.positions[t[corner]]) - glm::dvec3(view_.position);
      const double x = glm::dot(d, glm::dvec3(view_.right)), y = glm::dot(d, glm::dvec3(view_.up));
      const double z = glm::dot(d, glm::dvec3(view_.forward));
      const double scale = view_.perspective ? z : 1.0, slack = 1e-5 * (1 + glm::length(d));
      const double across = scale * view_.extent.x, along = scale * view_.extent.y;
      const double inside[] = {across - x, across + x, along - y, along + y, view_.perspective ? z : 0};
      for (size_t plane = 0; plane < outside.size(); ++plane) outside[plane] += inside[plane] < -slack;
    }
    return std::ranges::none_of(outside, [](int corners) { return corners == 3; });
  }

 private:
  View view_;
};

glm::dvec3 face_normal(const Scene& scene, const glm::uvec3& t) {
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double length = glm::length(n);
  return length > 0 ? n / length : glm::dvec3(0);
}

class Plane {
 public:
  Plane(const Scene& scene, const glm::uvec3& t)
      : normal_(face_normal(scene, t)), at_(scene.positions[t.x]) {}
  double height(const glm::dvec3& point) const { return glm::dot(point - at_, normal_); }
  // The least and the largest height of points; +∞ and -∞ of none.
  std::pair<double, double> span(const std::vector<glm::dvec3>& points) const {
    double low = INFINITY, high = -INFINITY;
    for (const glm::dvec3& p : points) {
      const double h = height(p);
      low = std::min(low, h);
      high = std::max(high, h);
    }
    return {low, high};
  }

 private:
  glm::dvec3 normal_, at_;
};

// Corners of some triangles, each once.
std::vector<glm::dvec3> points_of(const Scene& scene, const std::vector<uint8_t>& triangles) {
  std::vector<uint8_t> used(scene.positions.size());
  for (size_t i = 0; i < triangles.size(); ++i)
    for (int corner = 0; triangles[i] && corner < 3; ++corner) used[scene.triangles[i][corner]] = 1;
  std::vector<glm::dvec3> points;
  for (size_t v = 0; v < used.size(); ++v)
    if (used[v]) points.emplace_back(scene.positions[v]);
  return points;
}

// All three normals lie on one side and within what positions in single precision leave of the face's; the
// rasteriser takes those for the face's own (frame/gbuffer.frag).
bool is_flat(const Scene& scene, const glm::uvec3& t) {
  const glm::dvec3 face = face_normal(scene, t);
  const double sign = glm::dot(glm::dvec3(scene.normals[t.x]), face) < 0 ? -1 : 1;
  for (int corner = 0; corner < 3; ++corner)
    if (!(glm::length(glm::dvec3(scene.normals[t[corner]]) - sign * face) < 1e-6)) return false;
  return true;
}

}  // namespace

TexelRange texel_range(const Scene& scene, int texture) {
  if (texture < 0 || scene.textures[texture].rgba.empty()) return {};
  const Texture& t = scene.textures[texture];
  std::array<uint8_t, 4> low{255, 255, 255, 255}, high{};
  for (size_t i = 0; i < t.rgba.size(); ++i) {
    low[i % 4] = std::min(low[i % 4], t.rgba[i]);
    high[i % 4] = std::max(high[i % 4], t.rgba[i]);
  }
  const auto decoded = [&](const std::array<uint8_t, 4>& v) {
    Texture one{"", 1, 1, t.srgb, {v.begin(), v.end()}};
    return sample_texture(one, {0.5f, 0.5f});
  };
  return {decoded(low), decoded(high)};
}

EffectSearch::EffectSearch(const Scene& scene) : materials_(scene.materials.size()) {}

void EffectSearch::add_pose(const Scene& scene, float aspect) {
  constexpr uint32_t kRows = 4096;
  const Frustum light(light_view(scene.light));
  const auto columns = static_cast<uint32_t>(std::ceil(aspect * kRows));
  const Frustum camera(camera_view(scene.camera, columns, kRows));
  Sight in_sight{std::vector<uint8_t>(scene.triangles.size()), std::vector<uint8_t>(scene.triangles.size())};
  for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const glm::uvec3& t = scene.triangles[i];
    const bool lit = light.may_hold(scene, t), seen = camera.may_hold(scene, t);
    if (!lit && !seen) continue;
    in_sight.lit[i] = lit;
    in_sight.seen[i] = seen;
    MaterialSight& sight = materials_[scene.triangle_material[i]];
    if (lit && !sight.lit) sight.lit = i;
    if (seen && !sight.seen) sight.seen = i;
    if (!smooth_ && !is_flat(scene, t)) smooth_ = i;
  }
  if (!occluder_.possible) occluder_ = find_occluder(scene, in_sight);
}

// A segment between two points crosses a triangle only where its plane parts them. So nothing occludes where
// all triangles in sight lie on one side of the plane of every triangle of the scene, in sight or not: their
// convex hull then does, and with it every light made of them. A surface also hides what is below its own
// horizon, or in its plane: every lit surface must be in front of each seen one, on the side that the camera
// sees, and the other way round.
Occluder EffectSearch::find_occluder(const Scene& scene, const Sight& sight) {
  constexpr size_t kMostTests = 50'000'000;
  const double slack = 1e-6 * scene.diagonal();
  const auto lit = points_of(scene, sight.lit), seen = points_of(scene, sight.seen);
  const bool spot = scene.light.type == Light::Type::spot;
  const glm::dvec3 lamp =
      spot ? glm::dvec3(scene.light.position)
           : glm::dvec3(scene.light.position) - 1e3 * scene.diagonal() * glm::dvec3(scene.light.direction);
  // All triangles, by strides over the whole scene: neighbours tend to say the same.
  const size_t count = scene.triangles.size();
  size_t stride = std::max<size_t>(1, static_cast<size_t>(0.618 * static_cast<double>(count))), tests = 0;
  while (std::gcd(stride, count) != 1) ++stride;
  for (size_t k = 0, i = 0; k < count; ++k, i = (i + stride) % count) {
    const Plane plane(scene, scene.triangles[i]);
    const auto [below_lit, above_lit] = plane.span(lit);
    const auto [below_seen, above_seen] = plane.span(seen);
    tests += lit.size() + seen.size();
    const auto in_front = [&](const glm::dvec3& viewer, double below, double above) {
      const double side = plane.height(viewer);
      return side > slack ? below > slack : side < -slack && above < -slack;
    };
    const bool parts = std::min(below_lit, below_seen) < -slack && std::max(above_lit, above_seen) > slack;
    if (parts) return {true, fmt::format("the triangle {} may stand between lit and seen surfaces", i)};
    if ((sight.seen[i] && !in_front(scene.camera.position, below_lit, above_lit)) ||
        (sight.lit[i] && !in_front(lamp, below_seen, above_seen))) {
      return {true, fmt::format("the {} triangle {} has {} surfaces in its own plane or behind it",
                                sight.seen[i] ? "seen" : "lit", i, sight.seen[i] ? "lit" : "seen")};
    }
    if (tests > kMostTests)
      return {true, fmt::format("not decided: after {} of {} triangles the search stopped", k + 1, count)};
  }
  return {false, "all lit and seen surfaces face each other, with every triangle on one side"};
}

}  // namespace vsglbench
