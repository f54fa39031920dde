#include "image/static_flicker.h"

#include <algorithm>

#include "base/error.h"
#include "image/quantile.h"

namespace vsglbench {
namespace {

constexpr double kTail = 0.99;

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

double sum_of_channels(const glm::dvec3& v) { return v.x + v.y + v.z; }

uint64_t count_kept(const Mask& mask, size_t pixels) {
  return mask.empty() ? pixels
                      : static_cast<uint64_t>(std::ranges::count_if(mask, [](uint8_t m) { return m != 0; }));
}

}  // namespace

const MetricFormula& static_flicker_formula() {
  static const MetricFormula formula{
      "flicker.static",
      "flicker-static-mean-reference",
      "mean(sqrt(sum over seeds of (x_s - mean x)^2 / (S-1))) / mean(r), one frozen frame",
      {}};
  return formula;
}

StaticFlickerMeter::StaticFlickerMeter(const Image& r, const Mask& mask)
    : r_(r), mask_(mask), means_(r.pixels.size()), squares_(r.pixels.size()) {
  check_comparable(r, r, mask);
  const uint64_t kept = count_kept(mask, r.pixels.size());
  if (kept == 0) throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  for (size_t i = 0; i < r.pixels.size(); ++i)
    if (is_kept(mask, i)) mean_reference_ += sum_of_channels(r.pixels[i]);
  mean_reference_ /= 3 * static_cast<double>(kept);
}

void StaticFlickerMeter::add(const Image& x) {
  check_comparable(x, r_, mask_);
  ++seeds_;
  for (size_t i = 0; i < means_.size(); ++i) {
    const glm::dvec3 value(x.pixels[i]), before = value - means_[i];
    means_[i] += before / static_cast<double>(seeds_);
    squares_[i] += before * (value - means_[i]);
  }
}

std::optional<StaticFlicker> StaticFlickerMeter::finish() const {
  if (seeds_ < 2) {
    throw fail(ErrorKind::case_failed, "static flicker is told from two seeds on; there {}: give more seeds",
               seeds_ == 0 ? "is none" : "is one");
  }
  if (!(mean_reference_ > 0)) return std::nullopt;
  StaticFlicker out;
  out.mean_reference = mean_reference_;
  out.worst = -1;
  std::vector<double> deviations;
  double sum = 0;
  for (size_t i = 0; i < means_.size(); ++i) {
    if (!is_kept(mask_, i)) continue;
    const double d =
        sum_of_channels(glm::sqrt(squares_[i] / static_cast<double>(seeds_ - 1))) / 3 / mean_reference_;
    sum += d;
    deviations.push_back(d);
    if (d <= out.worst) continue;
    out.worst = d;
    out.worst_pixel = glm::uvec2(i % r_.width, i / r_.width);
  }
  out.value = sum / static_cast<double>(deviations.size());
  out.p99 = take_quantile(deviations, kTail);
  return out;
}

std::optional<double> StaticFlickerMeter::deviation(const Image& x) const {
  check_comparable(x, r_, mask_);
  if (seeds_ < 2)
    throw fail(ErrorKind::case_failed, "static flicker is told from two seeds on; give more seeds");
  if (!(mean_reference_ > 0)) return std::nullopt;
  double sum = 0;
  uint64_t pixels = 0;
  for (size_t i = 0; i < means_.size(); ++i) {
    if (!is_kept(mask_, i)) continue;
    sum += sum_of_channels(glm::abs(glm::dvec3(x.pixels[i]) - means_[i]));
    ++pixels;
  }
  return sum / (3 * static_cast<double>(pixels)) / mean_reference_;
}

}  // namespace vsglbench
