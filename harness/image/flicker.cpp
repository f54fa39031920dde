#include "image/flicker.h"

#include <algorithm>

#include "base/error.h"
#include "image/quantile.h"

namespace vsglbench {
namespace {

constexpr double kTail = 0.99;

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

double sum_of_channels(const glm::dvec3& v) { return v.x + v.y + v.z; }

}  // namespace

const MetricFormula& derivative_flicker_formula() {
  static const MetricFormula formula{
      "flicker.derivative",
      "flicker-derivative-mean-reference",
      "mean(|(x_t-x_{t-1}) - (r_t-r_{t-1})|) / mean(r), pixels with a surface at t-1 and t",
      {}};
  return formula;
}

void DerivativeFlickerMeter::check(const Image& x, const Image& r, const Mask& mask) const {
  check_comparable(x, r, mask);
  if (frames_ > 0 && (r.width != r_.width || r.height != r_.height)) {
    throw fail(ErrorKind::case_failed, "frame {} is {}x{} but the first one {}x{}", frames_, r.width,
               r.height, r_.width, r_.height);
  }
  for (size_t i = 0; i < r.pixels.size(); ++i)
    if (is_kept(mask, i) && (frames_ == 0 || is_kept(mask_, i))) return;
  if (frames_ == 0)
    throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  throw fail(ErrorKind::case_failed, "no pixel shows a surface both in frame {} and in frame {}", frames_ - 1,
             frames_);
}

void DerivativeFlickerMeter::add(const Image& x, const Image& r, const Mask& mask) {
  check(x, r, mask);
  if (frames_ == 0) {
    sums_.assign(r.pixels.size(), 0);
    counts_.assign(r.pixels.size(), 0);
  }
  double frame = 0;
  uint64_t pixels = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!is_kept(mask, i)) continue;
    sum_reference_ += sum_of_channels(r.pixels[i]);
    ++pixels_;
    if (frames_ == 0 || !is_kept(mask_, i)) continue;
    const glm::dvec3 moved = glm::dvec3(x.pixels[i]) - glm::dvec3(x_.pixels[i]);
    const glm::dvec3 should = glm::dvec3(r.pixels[i]) - glm::dvec3(r_.pixels[i]);
    const double d = sum_of_channels(glm::abs(moved - should)) / 3;
    sums_[i] += d;
    ++counts_[i];
    frame += d;
    ++pixels;
  }
  if (frames_ > 0) frame_means_.push_back(frame / static_cast<double>(pixels));
  total_ += frame;
  pairs_ += pixels;
  x_ = x, r_ = r, mask_ = mask;
  ++frames_;
}

std::optional<DerivativeFlicker> DerivativeFlickerMeter::finish() const {
  if (frames_ < 2) {
    throw fail(ErrorKind::case_failed,
               "flicker is told from two frames on; there {}: give the animation more frames",
               frames_ == 0 ? "is none" : "is one");
  }
  DerivativeFlicker out;
  out.mean_reference = sum_reference_ / (3 * static_cast<double>(pixels_));
  if (!(out.mean_reference > 0)) return std::nullopt;
  out.value = total_ / static_cast<double>(pairs_) / out.mean_reference;
  for (const double mean : frame_means_) out.series.push_back(mean / out.mean_reference);
  out.worst_frame = static_cast<uint64_t>(std::ranges::max_element(out.series) - out.series.begin()) + 1;
  std::vector<double> pixels;
  for (size_t i = 0; i < sums_.size(); ++i)
    if (counts_[i] > 0) pixels.push_back(sums_[i] / counts_[i]);
  out.p99 = take_quantile(pixels, kTail) / out.mean_reference;
  return out;
}

}  // namespace vsglbench
