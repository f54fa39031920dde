// Sources: Hyndman & Fan 1996 (quantile definitions); Efron 1979 (bootstrap); Hettmansperger & Sheather 1986,
// Confidence intervals based on interpolated order statistics.
#include "measure/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

namespace vsglbench {
namespace {

void require_samples(std::span<const double> samples) {
  if (samples.empty()) throw std::invalid_argument("statistics of no samples");
  for (const double s : samples) {
    if (!std::isfinite(s)) throw std::invalid_argument("statistics of a sample that is not finite");
  }
}

std::vector<double> sorted_copy(std::span<const double> samples) {
  std::vector<double> out(samples.begin(), samples.end());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

double quantile_sorted(std::span<const double> sorted, double p) {
  if (sorted.empty()) throw std::invalid_argument("a quantile of no samples");
  const double position = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto k = static_cast<size_t>(position);
  if (k + 1 >= sorted.size()) return sorted.back();
  return sorted[k] + (position - static_cast<double>(k)) * (sorted[k + 1] - sorted[k]);
}

double quantile(std::span<const double> samples, double p) {
  require_samples(samples);
  return quantile_sorted(sorted_copy(samples), p);
}

double median(std::span<const double> samples) { return quantile(samples, 0.5); }

MedianBootstrap::MedianBootstrap(std::span<const double> samples, uint64_t seed)
    : sorted_(sorted_copy(samples)), ranks_(samples.size()), random_(seed) {
  require_samples(samples);
}

double MedianBootstrap::draw() {
  // Drawing ranks of the sorted samples orders a resample by comparing integers.
  const size_t n = sorted_.size();
  for (uint32_t& rank : ranks_) rank = static_cast<uint32_t>((random_() >> 32) * n >> 32);
  const auto middle = ranks_.begin() + static_cast<ptrdiff_t>(n / 2);
  std::nth_element(ranks_.begin(), middle, ranks_.end());
  if (n % 2 == 1) return sorted_[*middle];
  return 0.5 * (sorted_[*std::max_element(ranks_.begin(), middle)] + sorted_[*middle]);
}

Interval bootstrap_median_ci95(std::span<const double> samples, int resamples, uint64_t seed) {
  if (resamples < 1) throw std::invalid_argument("a bootstrap of no resamples");
  MedianBootstrap bootstrap(samples, seed);
  std::vector<double> medians(static_cast<size_t>(resamples));
  for (double& m : medians) m = bootstrap.draw();
  std::sort(medians.begin(), medians.end());
  return {quantile_sorted(medians, 0.025), quantile_sorted(medians, 0.975)};
}

Interval median_ci95(std::span<const double> samples) {
  constexpr double kLevel = 0.97;
  require_samples(samples);
  const std::vector<double> x = sorted_copy(samples);
  const size_t n = x.size();
  const boost::math::binomial below(static_cast<double>(n), 0.5);  // how many lie below the median
  // Of the interval from the d-th to the d-th last.
  const auto level = [&](size_t d) { return 1 - 2 * boost::math::cdf(below, static_cast<double>(d - 1)); };
  if (level(1) <= kLevel) return {x.front(), x.back()};
  // 1. The narrowest that has the level: d is at least four standard deviations below the middle.
  const double first = std::floor(0.5 * static_cast<double>(n) - 2 * std::sqrt(static_cast<double>(n)));
  size_t d = first > 1 ? static_cast<size_t>(first) : 1;
  while (level(d + 1) > kLevel) ++d;
  // 2. From there towards the next, which lacks it.
  const double share = (level(d) - kLevel) / (level(d) - level(d + 1));
  const auto outer = static_cast<double>(d), inner = static_cast<double>(n - d);
  const double step = inner * share / (outer + (inner - outer) * share);
  return {x[d - 1] + step * (x[d] - x[d - 1]), x[n - d] - step * (x[n - d] - x[n - d - 1])};
}

double student_t95(int degrees) {
  if (degrees < 1) throw std::invalid_argument("Student's t needs a degree of freedom");
  return boost::math::quantile(boost::math::students_t(degrees), 0.975);
}

MeanEstimate mean_ci95(std::span<const double> samples) {
  require_samples(samples);
  const auto n = static_cast<double>(samples.size());
  MeanEstimate e;
  e.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / n;
  e.ci95 = {e.mean, e.mean};
  if (samples.size() < 2) return e;
  double square = 0;
  for (const double s : samples) square += (s - e.mean) * (s - e.mean);
  const double half = student_t95(static_cast<int>(samples.size()) - 1) * std::sqrt(square / (n - 1) / n);
  e.ci95 = {e.mean - half, e.mean + half};
  e.known = true;
  return e;
}

Summary summarize(std::vector<double> samples) {
  require_samples(samples);
  const std::vector<double> sorted = sorted_copy(samples);
  Summary s;
  s.median = quantile_sorted(sorted, 0.5);
  s.min = sorted.front();
  s.q1 = quantile_sorted(sorted, 0.25);
  s.q3 = quantile_sorted(sorted, 0.75);
  s.p95 = quantile_sorted(sorted, 0.95);
  s.ci95 = median_ci95(samples);
  s.samples = std::move(samples);
  return s;
}

}  // namespace vsglbench
