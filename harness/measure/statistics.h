// Order statistics, and the uncertainty of a median and of a mean.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace vsglbench {

struct Interval {
  double lo = 0, hi = 0;
  double width() const { return hi - lo; }
  bool contains(double v) const { return lo <= v && v <= hi; }
};

// Quantile p in [0,1] of sorted samples by linear interpolation between the order statistics at
// (n−1)p (Hyndman & Fan 1996, type 7). Throws std::invalid_argument when there are none.
double quantile_sorted(std::span<const double> sorted, double p);
double quantile(std::span<const double> samples, double p);
double median(std::span<const double> samples);

// Medians of draws with replacement. Deterministic in `seed`, on every platform.
class MedianBootstrap {
 public:
  MedianBootstrap(std::span<const double> samples, uint64_t seed);
  double draw();

 private:
  std::vector<double> sorted_;
  std::vector<uint32_t> ranks_;
  std::mt19937_64 random_;
};

// 95 % interval of the median by the percentile bootstrap (Efron 1979): the quantiles 2.5 % and
// 97.5 % of the medians of `resamples` draws. One sample s gives [s, s].
Interval bootstrap_median_ci95(std::span<const double> samples, int resamples = 1000, uint64_t seed = 1);

// 95 % interval of the median of samples whose count was chosen by looking at them (measure/stopping.h):
// between order statistics, interpolated (Hettmansperger & Sheather 1986), at the nominal level of 97 % for
// every look, as in a group sequential trial (Pocock 1977). That much leaves 95 %: stopping_test. Up to 6
// samples give their range, which holds the median in 1 − 2^(1−n) of all cases.
Interval median_ci95(std::span<const double> samples);

// t with P(|T| <= t) = 0.95 for Student's distribution of `degrees` >= 1 degrees of freedom.
double student_t95(int degrees);

// Mean of independent samples (one a seed) and Student's 95 % interval; one sample has an unbounded one:
// `known` is then false and the interval [mean, mean].
struct MeanEstimate {
  double mean = 0;
  Interval ci95;
  bool known = false;
};
MeanEstimate mean_ci95(std::span<const double> samples);

// What a report says of a set of times. Order statistics of type 7; ci95 is median_ci95().
struct Summary {
  std::vector<double> samples;  // in the order measured
  double median = 0, min = 0, q1 = 0, q3 = 0, p95 = 0;
  Interval ci95;
};
// Throws std::invalid_argument for no samples or a sample that is not finite.
Summary summarize(std::vector<double> samples);

}  // namespace vsglbench
