// How much a still picture would flicker if every frame took other random numbers.
//
// x is the image under test, r its reference, both linear RGB of one size; sums are in double precision.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "image/metrics.h"

namespace vsglbench {

// What reports call "static": "flicker-static-pairs-mean-reference".
const MetricFormula& static_flicker_formula();

struct StaticFlicker {
  double value = 0;  // mean over pairs of seeds, pixels and channels
  double p99 = 0;    // 99th percentile over pixels of the mean over pairs and channels
  // How far the image of each seed is from those of the others, mean over them; `value` is the mean of these.
  std::vector<double> series;
  // The jackknife's: their mean is `value`, and they are as good as independent, so that Student's interval
  // of their mean is the value's. Empty for two seeds, which tell no interval.
  std::vector<double> pseudovalues;
  double mean_reference = 0;
};

// mean |x_s − x_s'| over all pairs of seeds, x_s the same frozen frame with the random numbers of seed s,
// over mean(r) of the frame's mask. It is what the derivative's flicker is of an animation in which nothing
// moves and every frame takes another seed; of Gaussian noise 2/√π = 1.128 of its standard deviation. It has
// no bias however few the seeds, which a standard deviation has where spikes are rare: of 4 seeds it sees two
// thirds. Nothing where the reference is black. Throws Error(case_failed) for fewer than two images, as
// measure_errors does for what can't be compared, and where the mask keeps nothing.
std::optional<StaticFlicker> static_flicker(std::span<const Image> seeds, const Image& r,
                                            const Mask& mask = {});

}  // namespace vsglbench
