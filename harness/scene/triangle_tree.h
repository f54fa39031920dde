// Rays against a scene's triangles, for choosing views and drawing previews while a scene is being made: a
// few hundred thousand rays, no device, no ray-tracing library. What is measured goes by reference/tracer.h.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace vsglbench {

struct TreeHit {
  uint32_t triangle = 0;
  float distance = 0;        // along the unit direction, metres
  glm::vec2 barycentric{0};  // weights of the triangle's second and third vertex
};

// A hierarchy of boxes, split at the median of the longest side. Alpha masks are not read: a leaf's card is
// solid here.
class TriangleTree {
 public:
  // Keeps a reference to `scene`, which must not change while the tree lives.
  explicit TriangleTree(const Scene& scene);

  // The closest triangle in front of `origin`, by more than 0 and at most `end`.
  std::optional<TreeHit> intersect(const glm::vec3& origin, const glm::vec3& direction,
                                   float end = std::numeric_limits<float>::infinity()) const;
  // Whether something lies between two points, which may be on surfaces: the last 1e-4 of the scene's
  // diagonal at either end does not count.
  bool occluded(const glm::vec3& from, const glm::vec3& to) const;

  const Scene& scene() const { return scene_; }

 private:
  struct Node {
    glm::vec3 low, high;
    uint32_t first = 0, count = 0;  // count > 0: a leaf, of triangles order_[first …); else its children
  };
  void split(uint32_t node, uint32_t first, uint32_t count, std::vector<glm::vec3>* centres);
  // Calls visit(triangle, &end) for what the ray may meet before `end`, until that returns true.
  template <class Visit>
  void walk(const glm::vec3& origin, const glm::vec3& direction, float end, const Visit& visit) const;
  std::optional<TreeHit> meet(uint32_t triangle, const glm::vec3& origin, const glm::vec3& direction) const;

  const Scene& scene_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace vsglbench
