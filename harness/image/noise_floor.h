// How far an exact image would seem to be from a reference that is itself a mean of samples.
//
// Let A and B be means of the two independent halves of the samples and M = (A+B)/2 the reference. With
// errors a and b of the halves, M is off by (a+b)/2 and A differs from M by (a−b)/2. As b and −b are equally
// likely where noise is symmetric, both have the same distribution: a half against M is a sample of truth
// against M, for every metric, without a factor for each. Its RMSE is half of that of A against B, its MRSE a
// quarter, its SMAPE half where noise is small. At 10 % noise a pixel it is right to 4 %; at 30 %, where
// errors of M and M itself go together, SMAPE's is 6 % too high, FLIP's 7 % too high and MRSE's 32 % too low
// (noise_floor_test.cpp).
#pragma once

#include "image/metrics.h"

namespace vsglbench {

// Means over the two halves. Empty where the metric is; there is none of bias: halves say nothing of their
// mean.
struct NoiseFloor {
  double smape = 0, rmse = 0;
  std::optional<double> smape_lit, rrmse, mrse, flip;
};

// Without flip, which takes longer. Throws as measure_errors does.
NoiseFloor noise_floor_of(const Image& half0, const Image& half1, const Image& mean, const Mask& mask);
// The floor of flip.
std::optional<double> flip_floor_of(const Image& half0, const Image& half1, const Image& mean,
                                    const Mask& mask);

}  // namespace vsglbench
