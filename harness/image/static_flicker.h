// How much a still picture would flicker if every frame took other random numbers. Fed seed by seed; keeps
// sums per pixel, however many seeds there are.
//
// x is the image under test, r its reference, both linear RGB of one size; sums are in double precision.
#pragma once

#include <optional>
#include <vector>

#include "image/metrics.h"

namespace vsglbench {

// What reports call "static": "flicker-static-mean-reference".
const MetricFormula& static_flicker_formula();

struct StaticFlicker {
  double value = 0;          // mean over pixels and channels
  double p99 = 0;            // over pixels, of the mean of three channels
  double worst = 0;          // the largest pixel, of the mean of three channels
  glm::uvec2 worst_pixel{};  // its (x, y)
  double mean_reference = 0;
};

// √(Σ_s (x_s − x̄)² / (S − 1)) of every pixel and channel, x_s the same frozen frame with the random numbers
// of seed s, over mean(r) of the frame's mask: by Welford's recurrence. The variance is unbiased; its root is
// low for few seeds, of Gaussian noise by 3.5 % at S = 8, so that only values of equal S compare.
class StaticFlickerMeter {
 public:
  // Throws Error(case_failed) when the mask keeps nothing or r holds a NaN or Inf.
  explicit StaticFlickerMeter(const Image& r, const Mask& mask = {});
  // The image of the next seed. Throws as measure_errors does.
  void add(const Image& x);
  // Of all seeds so far. Nothing where the reference is black. Throws Error(case_failed) before the second.
  std::optional<StaticFlicker> finish() const;
  // How far the image of one seed is from the mean of all: mean |x_s − x̄| / mean(r) over pixels and channels.
  // The largest is of the worst seed. As x̄ is known after the last seed only, the images are given a second
  // time. Throws as add and finish do.
  std::optional<double> deviation(const Image& x) const;

 private:
  Image r_;
  Mask mask_;
  std::vector<glm::dvec3> means_, squares_;  // x̄ and Σ (x − x̄)²
  double mean_reference_ = 0;
  uint64_t seeds_ = 0;
};

}  // namespace vsglbench
