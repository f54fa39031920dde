#include "frame/ism_surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vsglbench {

namespace {

constexpr double kLargestShare = 1.0 / 1024;  // of the scene's area, in one triangle or one cluster

struct Builder {
  const Scene& scene;
  SurfaceClusters out;
  double largest = 0;  // m²

  glm::dvec3 at(uint32_t i) const { return glm::dvec3(out.positions[i]); }
  glm::dvec3 twice_area(const glm::uvec3& t) const {
    return glm::cross(at(t.y) - at(t.x), at(t.z) - at(t.x));
  }
  double area(const glm::uvec3& t) const { return 0.5 * glm::length(twice_area(t)); }
  glm::dvec3 centroid(const glm::uvec3& t) const { return (at(t.x) + at(t.y) + at(t.z)) / 3.0; }
  double longest_edge(const glm::uvec3& t) const {
    return std::max(
        {glm::distance(at(t.x), at(t.y)), glm::distance(at(t.y), at(t.z)), glm::distance(at(t.z), at(t.x))});
  }

  // Halves at the longest edge until no piece is larger than `largest`.
  void split(const glm::uvec3& triangle) {
    std::vector<glm::uvec3> waiting = {triangle};
    while (!waiting.empty()) {
      glm::uvec3 t = waiting.back();
      waiting.pop_back();
      const double a = area(t);
      if (!(a > 0)) continue;
      if (a <= largest) {
        out.triangles.push_back(t);
        continue;
      }
      for (int turn = 0; turn < 2 && glm::distance(at(t.x), at(t.y)) < longest_edge(t); ++turn)
        t = {t.y, t.z, t.x};
      const auto middle = static_cast<uint32_t>(out.positions.size());
      out.positions.push_back(glm::vec3(0.5 * (at(t.x) + at(t.y))));
      waiting.push_back({t.x, middle, t.z});
      waiting.push_back({middle, t.y, t.z});
    }
  }

  // Ten bits an axis, interleaved.
  uint32_t morton(const glm::dvec3& p) const {
    const glm::dvec3 size = glm::max(glm::dvec3(scene.bounds_max - scene.bounds_min), glm::dvec3(1e-9));
    const glm::dvec3 q = glm::clamp((p - glm::dvec3(scene.bounds_min)) / size, 0.0, 1.0) * 1023.0;
    uint32_t code = 0;
    for (int bit = 0; bit < 10; ++bit)
      for (int axis = 0; axis < 3; ++axis)
        code |= (static_cast<uint32_t>(q[axis]) >> bit & 1u) << (3 * bit + axis);
    return code;
  }

  // Triangles of like size first, so that one large triangle does not widen a cluster of small ones; near
  // ones among them.
  void sort() {
    using Key = std::tuple<int, uint32_t, uint32_t>;  // power of 4 of the longest edge, place, triangle
    std::vector<Key> order(out.triangles.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
      const glm::uvec3& t = out.triangles[i];
      order[i] = {static_cast<int>(std::floor(0.5 * std::log2(longest_edge(t)))), morton(centroid(t)), i};
    }
    std::sort(order.begin(), order.end());
    std::vector<glm::uvec3> sorted(order.size());
    for (size_t i = 0; i < order.size(); ++i) sorted[i] = out.triangles[std::get<2>(order[i])];
    out.triangles = std::move(sorted);
  }

  void add_cluster(uint32_t first, uint32_t end) {
    std::stable_sort(out.triangles.begin() + first, out.triangles.begin() + end,
                     [&](const auto& a, const auto& b) { return longest_edge(a) > longest_edge(b); });
    SurfaceCluster c{.first = first, .count = end - first};
    glm::dvec3 low(1e300), high(-1e300);
    double total = 0;
    std::array<double, 6> facing{};
    for (uint32_t i = first; i < end; ++i) {
      const glm::uvec3& t = out.triangles[i];
      low = glm::min(low, glm::min(at(t.x), glm::min(at(t.y), at(t.z))));
      high = glm::max(high, glm::max(at(t.x), glm::max(at(t.y), at(t.z))));
      const double a = area(t);
      const glm::dvec3 n = glm::normalize(twice_area(t));
      const std::array products = {n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.x * n.z, n.y * n.z};
      for (size_t k = 0; k < facing.size(); ++k) facing[k] += a * products[k];
      out.area.push_back(static_cast<float>(total += a));
    }
    c.centre = glm::vec3(0.5 * (low + high));
    c.radius = static_cast<float>(0.5 * glm::length(high - low));
    c.area = out.area.back();
    c.longest_edge = static_cast<float>(longest_edge(out.triangles[first]));
    for (size_t k = 0; k < facing.size(); ++k) c.facing[k] = static_cast<float>(facing[k] / total);
    out.clusters.push_back(c);
  }

  // At most 2047 clusters end because they are full, and 2048 because with the next triangle they would have
  // more than 1/1024 of the area; one is the last.
  void cut() {
    const auto most = static_cast<uint32_t>(out.triangles.size() / (SurfaceClusters::kMost / 2 - 1) + 1);
    uint32_t first = 0;
    double held = 0;
    for (uint32_t i = 0; i < out.triangles.size(); ++i) {
      const double a = area(out.triangles[i]);
      if (i > first && (i - first == most || held + a > largest)) {
        add_cluster(first, i);
        first = i;
        held = 0;
      }
      held += a;
    }
    if (first < out.triangles.size()) add_cluster(first, static_cast<uint32_t>(out.triangles.size()));
  }
};

}  // namespace

SurfaceClusters cluster_surface(const Scene& scene) {
  Builder builder{scene};
  builder.out.positions = scene.positions;
  double total = 0;
  for (const auto& t : scene.triangles) total += builder.area(t);
  builder.largest = total * kLargestShare;
  for (const auto& t : scene.triangles) builder.split(t);
  builder.sort();
  builder.cut();
  return std::move(builder.out);
}

SurfaceClustersGpu::SurfaceClustersGpu(Device& device, const SurfaceClusters& surface)
    : positions(device, "surface positions", surface.positions.size() * sizeof(glm::vec3)),
      triangles(device, "surface triangles", surface.triangles.size() * sizeof(glm::uvec3)),
      area(device, "surface areas", surface.area.size() * sizeof(float)),
      clusters(device, "surface clusters", surface.clusters.size() * sizeof(SurfaceCluster)),
      cluster_count(static_cast<uint32_t>(surface.clusters.size())) {
  positions.upload(std::span<const glm::vec3>(surface.positions));
  triangles.upload(std::span<const glm::uvec3>(surface.triangles));
  area.upload(std::span<const float>(surface.area));
  clusters.upload(std::span<const SurfaceCluster>(surface.clusters));
}

}  // namespace vsglbench
