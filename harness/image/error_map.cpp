#include "image/error_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

constexpr glm::u8vec3 kNotFinite{255, 0, 255};

}  // namespace

Image error_map(const Image& x, const Image& r, const Mask& mask) {
  if (x.width != r.width || x.height != r.height || (!mask.empty() && mask.size() != r.pixels.size())) {
    throw fail(ErrorKind::case_failed, "an error map of {}x{} pixels against {}x{} ({} in the mask)", x.width,
               x.height, r.width, r.height, mask.size());
  }
  Image out(r.width, r.height);
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    const double a = luminance(x.pixels[i]), b = luminance(r.pixels[i]), sum = std::abs(a) + std::abs(b);
    if (!std::isfinite(sum)) {
      out.pixels[i] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    } else if (sum > 0) {
      out.pixels[i] = glm::vec3(static_cast<float>((a - b) / (0.5 * sum)));
    }
  }
  return out;
}

double clipped_share(const Image& error, float range, const Mask& mask) {
  size_t counted = 0, clipped = 0;
  for (size_t i = 0; i < error.pixels.size(); ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    ++counted;
    clipped += std::abs(error.pixels[i].x) > range;
  }
  return counted == 0 ? 0 : static_cast<double>(clipped) / static_cast<double>(counted);
}

glm::u8vec3 diverging_color(float t) {
  const auto& colors = theme().errors;
  const float at = (std::clamp(t, -1.0f, 1.0f) + 1) * 0.5f * (colors.size() - 1);
  const size_t k = std::min(static_cast<size_t>(at), colors.size() - 2);
  return glm::u8vec3(glm::mix(colors[k], colors[k + 1], at - static_cast<float>(k)) + 0.5f);
}

Bitmap color_error_map(const Image& error, float range, const Mask& mask) {
  Bitmap out(error.width, error.height);
  for (size_t i = 0; i < error.pixels.size(); ++i) {
    const float e = error.pixels[i].x;
    glm::u8vec3 color = std::isfinite(e) ? diverging_color(e / range) : kNotFinite;
    if (std::isfinite(e) && !mask.empty() && mask[i] == 0) color = theme().no_surface;
    for (int c = 0; c < 3; ++c) out.bytes[3 * i + c] = color[c];
  }
  return out;
}

}  // namespace vsglbench
