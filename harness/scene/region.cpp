#include "scene/region.h"

#include <algorithm>
#include <cmath>

namespace vsglbench {
namespace {

// How many of `count` pixels have their centre left of, or above, this share of them.
uint32_t centres_before(double share, uint32_t count) {
  return static_cast<uint32_t>(std::clamp(std::ceil(share * count - 0.5), 0.0, double(count)));
}

}  // namespace

std::optional<Crop> pixels_of(const Region& region, uint32_t width, uint32_t height) {
  const uint32_t left = centres_before(region.x0, width), right = centres_before(region.x1, width);
  const uint32_t top = centres_before(region.y0, height), bottom = centres_before(region.y1, height);
  if (left >= right || top >= bottom) return std::nullopt;
  return Crop{left, top, right - left, bottom - top};
}

}  // namespace vsglbench
