// Faster, slower, or not to be told apart.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "measure/statistics.h"

namespace vsglbench {

// median(a) / median(b) and its 95 % percentile-bootstrap interval, a and b resampled independently.
struct Ratio {
  double value = 1;
  Interval ci95{1, 1};
};
// Throws std::invalid_argument unless every sample is finite and above 0.
Ratio median_ratio(std::span<const double> a, std::span<const double> b, uint64_t seed = 1);

// The relative difference that the machine shows where there is none: the factor farthest from 1 in the
// interval of an A/A pair, as a factor above 1, minus 1. An interval of [0.98, 1.01] gives 1/0.98 − 1.
double noise_floor(const Ratio& aa);

enum class Verdict { faster, slower, ambiguous };
std::string_view name(Verdict verdict);

// Whether `a` takes less time than `b`: faster (slower) when the two medians' intervals do not overlap and
// the interval of their ratio lies wholly beyond the noise floor; ambiguous else.
Verdict compare_times(std::span<const double> a, std::span<const double> b, double noise_floor,
                      uint64_t seed = 1);

}  // namespace vsglbench
