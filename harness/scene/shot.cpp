#include "scene/shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/image.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

constexpr uint32_t kRows = 4096;  // of an image as far as its aspect goes

double share(size_t part, size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

// Irradiance that a light alone would bring to a point, W/m².
double direct_irradiance(const Light& light, const View& view, const ShotPoint& at) {
  const double power = luminance(light.power);
  if (!view.perspective) return power * std::max(0.0f, -glm::dot(at.normal, view.forward));
  const glm::dvec3 way = glm::dvec3(view.position) - glm::dvec3(at.position);
  const double d2 = glm::dot(way, way);
  return d2 > 0 ? power * std::max(0.0, glm::dot(glm::dvec3(at.normal), way)) / (d2 * std::sqrt(d2)) : 0;
}

// Irradiance at `to` per watt that `from` reflects diffusely, without regard to what stands between.
double transfer(const ShotPoint& from, const ShotPoint& to) {
  const glm::dvec3 way = glm::dvec3(to.position) - glm::dvec3(from.position);
  const double d2 = glm::dot(way, way);
  if (!(d2 > 0)) return 0;
  const double cosines = std::max(0.0, glm::dot(glm::dvec3(from.normal), way)) *
                         std::max(0.0, -glm::dot(glm::dvec3(to.normal), way));
  return cosines / (d2 * d2) / std::numbers::pi;
}

}  // namespace

View view_of(const Camera& camera, float aspect) {
  return camera_view(camera, static_cast<uint32_t>(std::lround(aspect * kRows)), kRows);
}

bool sees(const TriangleTree& tree, const View& view, const glm::vec3& point) {
  const auto uv = view.project(point);
  if (!uv) return false;
  glm::vec3 origin, direction;
  view.ray(*uv, &origin, &direction);
  return !tree.occluded(view.perspective ? view.position : origin, point);
}

std::vector<ShotPoint> points_seen(const TriangleTree& tree, const View& view, uint32_t across,
                                   uint32_t down) {
  std::vector<ShotPoint> points;
  for (uint32_t y = 0; y < down; ++y) {
    // By a golden section from row to row, or an upright pole would be between all columns.
    const float shift = glm::fract(0.5f + 0.618034f * static_cast<float>(y));
    for (uint32_t x = 0; x < across; ++x) {
      const glm::vec2 uv((static_cast<float>(x) + shift) / static_cast<float>(across),
                         (static_cast<float>(y) + 0.5f) / static_cast<float>(down));
      glm::vec3 origin, direction;
      view.ray(uv, &origin, &direction);
      const auto hit = tree.intersect(origin, direction);
      if (!hit) continue;
      const Surface s = surface_at(tree.scene(), hit->triangle, hit->barycentric, -direction);
      const glm::uvec3& t = tree.scene().triangles[hit->triangle];
      const glm::vec3& a = tree.scene().positions[t.x];
      const glm::vec3 turn = glm::cross(tree.scene().positions[t.y] - a, tree.scene().positions[t.z] - a);
      points.push_back({s.position, s.geometric_normal, std::min(1.0f, luminance(s.diffuse + s.f0)),
                        hit->triangle, hit->distance, glm::dot(turn, direction) < 0});
    }
  }
  return points;
}

ShotMeasure measure_shot(const TriangleTree& tree, const Shot& shot, const std::vector<ShotPoint>& seen,
                         const ShotRays& rays) {
  ShotMeasure m;
  const uint32_t across = static_cast<uint32_t>(std::lround(rays.aspect * static_cast<float>(rays.image)));
  m.seen = share(seen.size(), size_t(across) * rays.image);
  if (seen.empty()) return m;
  const auto on_subject = [&](const ShotPoint& p) { return p.triangle < rays.subject_triangles; };
  m.subject = share(static_cast<size_t>(std::ranges::count_if(seen, on_subject)), seen.size());
  std::vector<float> depths;
  for (const ShotPoint& p : seen) depths.push_back(p.distance);
  std::ranges::nth_element(depths, depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2));
  m.depth = depths[depths.size() / 2];

  const View light = light_view(shot.light), camera = view_of(shot.camera, rays.aspect);
  const std::vector<ShotPoint> lit = points_seen(tree, light, rays.light, rays.light);
  m.lit = share(lit.size(), size_t(rays.light) * rays.light);
  if (lit.empty()) return m;
  m.lit_seen = share(static_cast<size_t>(std::ranges::count_if(
                         lit, [&](const ShotPoint& p) { return sees(tree, camera, p.position); })),
                     lit.size());
  std::vector<float> distances;
  for (const ShotPoint& p : lit) distances.push_back(p.distance);
  std::ranges::sort(distances);
  m.nearest = distances[distances.size() / 10];

  // Each lit point stands for an equal share of the light's square, and reflects what falls there.
  const double watt =
      luminance(glm::vec3(flux_density(shot.light, {0.5f, 0.5f}))) / (double(rays.light) * rays.light);
  const double spacing = 2.0 * light.extent.x / rays.light * (light.perspective ? m.nearest : 1.0);
  const double nearest_link = 1 / (std::numbers::pi * std::max(1e-30, spacing * spacing));
  size_t directly = 0, subject_directly = 0, reached = 0, at = 0;
  double direct = 0, indirect = 0;
  for (const ShotPoint& p : seen) {
    if (const double e = direct_irradiance(shot.light, light, p); e > 0 && sees(tree, light, p.position)) {
      ++directly;
      subject_directly += on_subject(p);
      direct += e;
    }
    bool met = false;
    for (uint32_t k = 0; k < rays.links; ++k) {
      // Strides of a golden section: neighbours take lit points far apart.
      at = (at + std::max<size_t>(1, lit.size() * 618 / 1000)) % lit.size();
      const double weight = transfer(lit[at], p);
      if (!(weight > 0) || tree.occluded(lit[at].position, p.position)) continue;
      met = true;
      // A link shorter than the lit points are apart tells of itself only.
      indirect += std::min(weight, nearest_link) * static_cast<double>(lit.size()) * watt *
                  lit[at].reflectance / rays.links;
    }
    reached += met;
  }
  m.direct = share(directly, seen.size());
  m.subject_direct = share(subject_directly, static_cast<size_t>(std::ranges::count_if(seen, on_subject)));
  m.reached = share(reached, seen.size());
  m.strength = direct > 0 ? indirect / direct : 0;
  return m;
}

ShotMeasure measure_shot(const TriangleTree& tree, const Shot& shot, const ShotRays& rays) {
  const auto across = static_cast<uint32_t>(std::lround(rays.aspect * static_cast<float>(rays.image)));
  return measure_shot(tree, shot, points_seen(tree, view_of(shot.camera, rays.aspect), across, rays.image),
                      rays);
}

}  // namespace vsglbench
