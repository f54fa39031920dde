// What of a scene the light lights and the camera sees, found without rendering: the facts from which
// effects.h decides. Everything is an upper bound: a surface may be called lit or seen that is not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace vsglbench {

// Of a texture, the least and the largest value of each channel, 0 … 1, decoded; of none, 1.
struct TexelRange {
  glm::vec4 low{1}, high{1};
};
TexelRange texel_range(const Scene& scene, int texture);

// The first triangle of a material that is in the light's, and in the camera's frustum.
struct MaterialSight {
  std::optional<uint32_t> lit, seen;
};

// Whether anything may stand between a lit and a seen point.
struct Occluder {
  bool possible = false;
  std::string reason;
};

class EffectSearch {
 public:
  // Geometry may move from pose to pose; materials and their triangles may not.
  explicit EffectSearch(const Scene& scene);
  // One frame. `aspect`: width over height of the image.
  void add_pose(const Scene& scene, float aspect);

  const std::vector<MaterialSight>& materials() const { return materials_; }
  // The first lit or seen triangle with a vertex normal off its face's.
  std::optional<uint32_t> smooth() const { return smooth_; }
  const Occluder& occluder() const { return occluder_; }

 private:
  // A flag for each triangle.
  struct Sight {
    std::vector<uint8_t> lit, seen;
  };
  static Occluder find_occluder(const Scene& scene, const Sight& sight);
  std::vector<MaterialSight> materials_;
  std::optional<uint32_t> smooth_;
  Occluder occluder_;
};

}  // namespace vsglbench
