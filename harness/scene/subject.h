// What the pictures of a model are of, and where a camera may stand to take them: before an object, so that
// all of it is in the frame, or within a place, as a room is one.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/triangle_tree.h"

namespace vsglbench {

// Unit, `azimuth` round the vertical axis from +z towards +x, `elevation` above the horizon, degrees.
glm::vec3 direction_of(float azimuth, float elevation);
// An up for a view along `direction`: Y as far as that goes.
glm::vec3 up_for(const glm::vec3& direction);

class Subject {
 public:
  // Of the first `triangles` triangles of the tree's scene; keeps a reference to the tree.
  Subject(const TriangleTree& tree, uint32_t triangles);

  glm::vec3 centre() const { return 0.5f * (low_ + high_); }
  float radius() const { return 0.5f * glm::length(high_ - low_); }
  bool contains(const glm::vec3& p) const;  // within its bounds

  // Points at shares of the bounds' sides: of both horizontal ones each of `sides`, of the vertical one each
  // of `heights`.
  std::vector<glm::vec3> grid(const std::vector<float>& sides, const std::vector<float>& heights) const;

  // Where a camera that looks along `direction`, with a picture `aspect` times as wide as high, must stand to
  // have all of it in the frame, in the middle, with a margin of a tenth of the picture.
  glm::vec3 eye_before(const glm::vec3& direction, float vfov, float aspect) const;

  // Whether geometry lies round a point in most directions, as in a room, and not beside it, as in the hollow
  // of an object.
  bool surrounds(const glm::vec3& point) const;

  // Whether one is within it: from a third of the points in its bounds one sees walls all round, and sees
  // them from their front. That is a room, a corridor or a hall, closed or nearly so, whether its walls have
  // a thickness or not. A solid is none, as from within one sees the backs of its faces; nor is what is open
  // to a side or above, as a shelf, a cup or a courtyard: all of that is seen from outside.
  bool is_place() const;

 private:
  struct Round {
    int directions = 0, hits = 0, fronts = 0;
  };
  Round look_round(const glm::vec3& point) const;

  const TriangleTree& tree_;
  glm::vec3 low_, high_;
  std::vector<glm::vec3> outline_;  // its corners that are farthest in many directions
};

}  // namespace vsglbench
