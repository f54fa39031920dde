#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "base/parallel.h"
#include "image/flip_color.h"
#include "image/quantile.h"

namespace vsglbench {
namespace {

constexpr double kToneTarget = 0.85;
constexpr float kLargestScale = 1e38f;
constexpr uint64_t kMostKept = uint64_t(512) << 20;  // bytes; a larger reference is looked at anew each time
constexpr uint64_t kMostInWork = uint64_t(2) << 30, kInWorkPerPixel = 100;  // bytes; of exposures at a time

double luminance64(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<FlipExposures> flip_exposures(const Image& r, const Mask& mask) {
  std::vector<double> all, lit;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!mask.empty() && !mask[i]) continue;
    all.push_back(luminance64(glm::max(r.pixels[i], glm::vec3(0))));
    if (all.back() > 0) lit.push_back(all.back());
  }
  if (lit.empty()) return std::nullopt;
  const double white = aces_inverse(kToneTarget);
  FlipExposures out;
  out.start = std::log2(white / *std::max_element(lit.begin(), lit.end()));
  const double middle = median_of(all);
  out.stop = middle > 0 ? std::log2(white / middle)
                        : std::min(std::log2(white / median_of(lit)), out.start + kFlipMostStops);
  out.count = static_cast<uint32_t>(std::max(2.0, std::ceil(out.stop - out.start)));
  return out;
}

FlipReference::FlipReference(const Image& r, const Mask& mask, const FlipExposures& exposures)
    : reference_(r),
      mask_(mask),
      exposures_(exposures),
      achromatic_(achromatic_sensitivity(kFlipPixelsPerDegree)),
      red_green_(red_green_sensitivity(kFlipPixelsPerDegree)),
      blue_yellow_(blue_yellow_sensitivity(kFlipPixelsPerDegree)) {
  if (r.pixels.size() * exposures.count * (sizeof(glm::vec3) + 2 * sizeof(float)) > kMostKept) return;
  views_.resize(exposures.count);
  at_every_exposure([&](uint32_t i) { views_[i] = view(r, exposures.exposure(i)); });
}

// In no order, several at a time.
template <class Work>
void FlipReference::at_every_exposure(const Work& work) const {
  const uint64_t fit = kMostInWork / (1 + reference_.pixels.size() * kInWorkPerPixel);
  const auto threads = static_cast<unsigned>(std::clamp<uint64_t>(fit, 1, thread_count(0)));
  parallel_for(exposures_.count, threads, [&](uint64_t i, unsigned) { work(static_cast<uint32_t>(i)); });
}

FlipReference::View FlipReference::view(const Image& image, double exposure) const {
  const float scale = static_cast<float>(std::min<double>(std::exp2(exposure), kLargestScale));
  Plane y(image.width, image.height), cx = y, cz = y;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (!mask_.empty() && !mask_[i]) continue;  // black: 0 in all three
    const glm::vec3 c = scale * glm::max(image.pixels[i], glm::vec3(0));
    const glm::vec3 opponent = to_opponent({aces(c.x), aces(c.y), aces(c.z)});
    y.values[i] = opponent.x;
    cx.values[i] = opponent.y;
    cz.values[i] = opponent.z;
  }
  View out;
  out.features = detect_features(y, kFlipPixelsPerDegree);
  y = filtered(y, achromatic_);
  cx = filtered(cx, red_green_);
  cz = filtered(cz, blue_yellow_);
  out.hunt_lab.resize(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const glm::vec3 linear = from_opponent({y.values[i], cx.values[i], cz.values[i]});
    out.hunt_lab[i] = to_hunt_lab(glm::clamp(linear, 0.0f, 1.0f));
  }
  return out;
}

Plane FlipReference::error_map(const Image& x) const {
  check_comparable(x, reference_, mask_);
  Plane worst(x.width, x.height);
  std::mutex mutex;
  at_every_exposure([&](uint32_t e) {
    const View seen = view(x, exposures_.exposure(e));
    View fresh;
    if (views_.empty()) fresh = view(reference_, exposures_.exposure(e));
    const View& r = views_.empty() ? fresh : views_[e];
    Plane errors(x.width, x.height);
    for (size_t i = 0; i < errors.values.size(); ++i) {
      if (!mask_.empty() && !mask_[i]) continue;
      const float edges = std::abs(seen.features.edges.values[i] - r.features.edges.values[i]);
      const float points = std::abs(seen.features.points.values[i] - r.features.points.values[i]);
      const float feature = std::sqrt(std::max(edges, points) / std::sqrt(2.0f));
      errors.values[i] = std::pow(color_error(seen.hunt_lab[i], r.hunt_lab[i]), 1 - feature);
    }
    const std::lock_guard lock(mutex);
    for (size_t i = 0; i < errors.values.size(); ++i)
      worst.values[i] = std::max(worst.values[i], errors.values[i]);
  });
  return worst;
}

FlipErrors FlipReference::compare(const Image& x) const {
  const Plane map = error_map(x);
  std::vector<float> kept;
  for (size_t i = 0; i < map.values.size(); ++i) {
    if (mask_.empty() || mask_[i]) kept.push_back(map.values[i]);
  }
  FlipErrors out;
  for (const float v : kept) out.mean += v;
  out.mean /= static_cast<double>(kept.size());
  out.p99 = take_quantile(kept, 0.99);
  out.exposures = exposures_;
  return out;
}

std::optional<FlipErrors> measure_flip(const Image& x, const Image& r, const Mask& mask) {
  check_comparable(x, r, mask);
  if (!mask.empty() && std::none_of(mask.begin(), mask.end(), [](uint8_t m) { return m; }))
    throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  const std::optional<FlipExposures> exposures = flip_exposures(r, mask);
  if (!exposures) return std::nullopt;
  return FlipReference(r, mask, *exposures).compare(x);
}

}  // namespace vsglbench
