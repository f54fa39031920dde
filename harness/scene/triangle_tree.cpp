#include "scene/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace vsglbench {
namespace {

constexpr uint32_t kLeaf = 4;    // triangles
constexpr float kClear = 1e-4f;  // of the diagonal, at the ends of a segment

// Distances at which a ray enters and leaves a box; empty where the first is larger.
std::pair<float, float> span_in_box(const glm::vec3& low, const glm::vec3& high, const glm::vec3& origin,
                                    const glm::vec3& inverse) {
  float enter = 0, leave = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    const float a = (low[k] - origin[k]) * inverse[k], b = (high[k] - origin[k]) * inverse[k];
    if (std::isnan(a) || std::isnan(b)) continue;  // along a side, and in its plane
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave * (1 + 4e-7f)};
}

}  // namespace

TriangleTree::TriangleTree(const Scene& scene) : scene_(scene), order_(scene.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<glm::vec3> centres;
  centres.reserve(order_.size());
  for (const glm::uvec3& t : scene.triangles)
    centres.push_back((scene.positions[t.x] + scene.positions[t.y] + scene.positions[t.z]) / 3.0f);
  nodes_.reserve(order_.size() + 1);
  nodes_.emplace_back();
  if (!order_.empty()) split(0, 0, static_cast<uint32_t>(order_.size()), &centres);
}

void TriangleTree::split(uint32_t node, uint32_t first, uint32_t count, std::vector<glm::vec3>* centres) {
  glm::vec3 low(INFINITY), high(-INFINITY), least(INFINITY), most(-INFINITY);
  for (uint32_t i = first; i < first + count; ++i) {
    const glm::uvec3& t = scene_.triangles[order_[i]];
    for (int corner = 0; corner < 3; ++corner) {
      low = glm::min(low, scene_.positions[t[corner]]);
      high = glm::max(high, scene_.positions[t[corner]]);
    }
    least = glm::min(least, (*centres)[order_[i]]);
    most = glm::max(most, (*centres)[order_[i]]);
  }
  nodes_[node] = {low, high, first, count};
  if (count <= kLeaf) return;
  const glm::vec3 sides = most - least;
  const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  const uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](uint32_t a, uint32_t b) {
    return std::pair((*centres)[a][axis], a) < std::pair((*centres)[b][axis], b);
  });
  const auto children = static_cast<uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  split(children, first, half, centres);
  split(children + 1, first + half, count - half, centres);
}

template <class Visit>
void TriangleTree::walk(const glm::vec3& origin, const glm::vec3& direction, float end,
                        const Visit& visit) const {
  if (order_.empty()) return;
  const glm::vec3 inverse = 1.0f / direction;
  std::array<std::pair<uint32_t, float>, 64> open;  // node, where the ray enters it
  size_t size = 0;
  const auto push = [&](uint32_t node) {
    const auto [enter, leave] = span_in_box(nodes_[node].low, nodes_[node].high, origin, inverse);
    if (enter <= leave && enter <= end) open.at(size++) = {node, enter};
  };
  push(0);
  while (size > 0) {
    const auto [index, enter] = open.at(--size);
    if (enter > end) continue;
    const Node& node = nodes_[index];
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
      if (visit(order_[i], &end)) return;
    if (node.count > 0) continue;
    push(node.first);
    push(node.first + 1);
    // The nearer one is looked at first.
    if (size >= 2 && open.at(size - 1).second > open.at(size - 2).second)
      std::swap(open.at(size - 1), open.at(size - 2));
  }
}

// Möller and Trumbore 1997, in double: the corners are exact, and slivers are met as they are.
std::optional<TreeHit> TriangleTree::meet(uint32_t triangle, const glm::vec3& origin,
                                          const glm::vec3& direction) const {
  const glm::uvec3& t = scene_.triangles[triangle];
  const glm::dvec3 a(scene_.positions[t.x]), d(direction);
  const glm::dvec3 e1 = glm::dvec3(scene_.positions[t.y]) - a, e2 = glm::dvec3(scene_.positions[t.z]) - a;
  const glm::dvec3 p = glm::cross(d, e2);
  const double determinant = glm::dot(e1, p);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 s = glm::dvec3(origin) - a, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant;
  const double distance = glm::dot(e2, q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) return std::nullopt;
  return TreeHit{triangle, static_cast<float>(distance), glm::vec2(u, v)};
}

std::optional<TreeHit> TriangleTree::intersect(const glm::vec3& origin, const glm::vec3& direction,
                                               float end) const {
  std::optional<TreeHit> nearest;
  walk(origin, direction, end, [&](uint32_t triangle, float* limit) {
    const auto hit = meet(triangle, origin, direction);
    if (hit && hit->distance <= *limit) {
      nearest = hit;
      *limit = hit->distance;
    }
    return false;
  });
  return nearest;
}

bool TriangleTree::occluded(const glm::vec3& from, const glm::vec3& to) const {
  const glm::vec3 way = to - from;
  const float length = glm::length(way), clear = kClear * scene_.diagonal();
  if (!(length > 2 * clear)) return false;
  const glm::vec3 direction = way / length;
  bool found = false;
  walk(from, direction, length, [&](uint32_t triangle, float*) {
    const auto hit = meet(triangle, from, direction);
    return found = hit && hit->distance > clear && hit->distance < length - clear;
  });
  return found;
}

}  // namespace vsglbench
