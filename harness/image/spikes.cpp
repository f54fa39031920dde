#include "image/spikes.h"

#include <algorithm>

#include "base/error.h"

namespace vsglbench {
namespace {

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

double luminance64(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// Of the 3×3 pixels around (x, y), as far as the image reaches.
double largest_nearby(const Image& r, uint32_t x, uint32_t y) {
  double largest = 0;
  for (uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, r.height - 1); ++v) {
    for (uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, r.width - 1); ++u)
      largest = std::max(largest, luminance64(r.at(u, v)));
  }
  return largest;
}

}  // namespace

std::optional<double> spike_share(const Image& x, const Image& r, const Mask& mask) {
  check_comparable(x, r, mask);
  uint64_t pixels = 0, spikes = 0;
  double mean = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!is_kept(mask, i)) continue;
    ++pixels;
    mean += luminance64(r.pixels[i]);
  }
  if (pixels == 0)
    throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  mean /= static_cast<double>(pixels);
  if (!(mean > 0)) return std::nullopt;
  for (uint32_t v = 0; v < r.height; ++v) {
    for (uint32_t u = 0; u < r.width; ++u) {
      const size_t i = size_t(v) * r.width + u;
      // What is no brighter than that is none, whatever is nearby.
      const double bright = luminance64(x.pixels[i]);
      if (!is_kept(mask, i) || !(bright > kSpikeOverMean * mean)) continue;
      spikes += bright > kSpikeOverNearby * largest_nearby(r, u, v);
    }
  }
  return static_cast<double>(spikes) / static_cast<double>(pixels);
}

}  // namespace vsglbench
