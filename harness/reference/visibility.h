// Exact visibility between G-buffer pixels and lights: one bit each [light-transport §6, `exact`].
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "reference/tracer.h"

namespace vsglbench {

struct ReceiverPoint {
  glm::vec3 position{0};          // metres, relative to Scene::origin
  glm::vec3 geometric_normal{0};  // unit, turned towards the eye
  bool valid = false;             // false: no surface at this pixel, its bits are 0
};

struct TargetPoint {
  glm::vec3 position{0};
  // The ray ends this far (metres) before the target, at least 0.
  float stop_short = 0;
};

// bit(light, pixel) = bit (pixel % 32) of words[light * words_per_light + pixel / 32]; 1 = visible.
// `pixel` = y * width + x.
struct VisibilityBits {
  uint32_t pixels = 0, lights = 0, words_per_light = 0;
  std::vector<uint32_t> words;
  uint64_t rays = 0;  // that were traced; a target behind the receiver's own face needs none
  double seconds = 0;

  bool visible(uint32_t light, uint32_t pixel) const {
    return words[size_t(light) * words_per_light + pixel / 32] >> (pixel % 32) & 1;
  }
};

// `receivers` holds width * height pixels, row-major. threads = 0: all.
VisibilityBits compute_visibility(const Tracer& tracer, std::span<const ReceiverPoint> receivers,
                                  uint32_t width, uint32_t height, std::span<const TargetPoint> targets,
                                  unsigned threads = 0);

}  // namespace vsglbench
