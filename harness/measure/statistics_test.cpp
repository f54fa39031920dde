#include "measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/test_chi_squared.h"

using namespace vsglbench;

namespace {

// Share of `trials` experiments of n draws each whose interval holds the truth.
template <class Draw, class MakeInterval>
double coverage(int trials, int n, double truth, Draw draw, MakeInterval make) {
  std::mt19937_64 random(7);
  int held = 0;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> samples(static_cast<size_t>(n));
    for (double& s : samples) s = draw(random);
    held += make(samples, static_cast<uint64_t>(t)).contains(truth);
  }
  return static_cast<double>(held) / trials;
}

template <class F>
double integral(const F& f, double from, double to) {
  constexpr int kPieces = 20000;
  const double h = (to - from) / kPieces;
  double sum = f(from) + f(to);
  for (int i = 1; i < kPieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

}  // namespace

TEST(Statistics, QuantilesInterpolateBetweenOrderStatistics) {
  // R: quantile(c(1,2,4,8,16), c(.25,.5,.75,.95), type=7) = 2, 4, 8, 14.4
  const std::vector<double> samples = {16, 1, 8, 2, 4};
  EXPECT_DOUBLE_EQ(quantile(samples, 0.25), 2);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.5), 4);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.75), 8);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.95), 14.4);
  EXPECT_DOUBLE_EQ(quantile(samples, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(samples, 1), 16);
  EXPECT_DOUBLE_EQ(median(std::vector<double>{3, 1}), 2);
  EXPECT_DOUBLE_EQ(median(std::vector<double>{5}), 5);
}

TEST(Statistics, StudentsTMatchesTheTables) {
  // Two-sided 95 %, Abramowitz & Stegun, Table 26.10.
  const std::pair<int, double> table[] = {{1, 12.706}, {2, 4.303}, {3, 3.182},  {4, 2.776},  {7, 2.365},
                                          {8, 2.306},  {9, 2.262}, {30, 2.042}, {120, 1.980}};
  for (const auto& [degrees, t] : table) EXPECT_NEAR(student_t95(degrees), t, 5.1e-4) << degrees;
  EXPECT_NEAR(student_t95(100000), 1.959964, 5e-5);
  EXPECT_THROW(student_t95(0), std::invalid_argument);
}

// By Simpson's rule over the density.
TEST(Statistics, QuantilesHoldTheirShareOfTheDensity) {
  for (const int n : {1, 2, 3, 7, 8, 30, 120}) {
    const double log_scale = std::lgamma((n + 1) / 2.0) - std::lgamma(n / 2.0) - 0.5 * std::log(n * M_PI);
    const auto student = [&](double t) {
      return std::exp(log_scale - (n + 1) / 2.0 * std::log1p(t * t / n));
    };
    EXPECT_NEAR(integral(student, 0, student_t95(n)), 0.475, 1e-10) << n << " degrees";
    if (n == 1) continue;  // χ² of one degree has a pole at 0
    const auto chi_squared = [&](double x) {
      return x > 0    ? std::exp((n / 2.0 - 1) * std::log(x / 2) - x / 2 - std::lgamma(n / 2.0)) / 2
             : n == 2 ? 0.5
                      : 0;
    };
    const double above = chi_squared_limit(n, 4), below = chi_squared_limit(n, -2);
    const double tail = integral(chi_squared, above, above + 300), body = integral(chi_squared, below, above);
    EXPECT_NEAR(tail, 0.5 * std::erfc(4 / std::sqrt(2)), 1e-10) << n;
    EXPECT_NEAR(body + tail, 1 - 0.5 * std::erfc(2 / std::sqrt(2)), 1e-9) << n;
  }
}

TEST(Statistics, MeanIntervalByHand) {
  // {1,2,3,4}: mean 2.5, s² = 5/3, half width = 3.182446 · √(5/12) = 2.054260
  const MeanEstimate e = mean_ci95(std::vector<double>{1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(e.mean, 2.5);
  EXPECT_TRUE(e.known);
  EXPECT_NEAR(e.ci95.hi - e.mean, 2.054260, 1e-5);
  EXPECT_NEAR(e.mean - e.ci95.lo, 2.054260, 1e-5);
  EXPECT_FALSE(mean_ci95(std::vector<double>{3}).known);
}

TEST(Statistics, MeanIntervalCoversTheMeanInNinetyFivePercent) {
  std::normal_distribution<double> normal(10, 3);
  const auto share = coverage(4000, 8, 10, normal, [](const auto& s, uint64_t) { return mean_ci95(s).ci95; });
  EXPECT_NEAR(share, 0.95, 0.011);  // 3.2 standard errors of a share of 4000
}

TEST(Statistics, BootstrapCoversTheMedianInNinetyFivePercent) {
  const auto interval = [](const auto& s, uint64_t seed) { return bootstrap_median_ci95(s, 1000, seed); };
  // Normal, and the skewed law that timings follow; the percentile bootstrap is within 2 % at n = 41.
  EXPECT_NEAR(coverage(1500, 41, 5, std::normal_distribution<double>(5, 1), interval), 0.95, 0.02);
  EXPECT_NEAR(coverage(1500, 41, std::log(2), std::exponential_distribution<double>(1), interval), 0.95,
              0.02);
}

TEST(Statistics, MedianIntervalByHand) {
  // Of 8 samples the range holds the median with 1 − 2/256 = 0.9921875, without the two ends with 1 − 18/256
  // = 0.9296875: I = 0.355, and λ = 7 I / (1 + 6 I) = 0.7939297.
  const Interval ci = median_ci95(std::vector<double>{7, 0, 1, 6, 3, 2, 5, 4});
  EXPECT_NEAR(ci.lo, 0.7939297, 1e-6);
  EXPECT_NEAR(ci.hi, 7 - 0.7939297, 1e-6);
  const Interval range = median_ci95(std::vector<double>{2, 9, 4, 1, 3, 5});  // 1 − 2/64 = 0.96875
  EXPECT_EQ(range.lo, 1);
  EXPECT_EQ(range.hi, 9);
  EXPECT_EQ(median_ci95(std::vector<double>{5}).width(), 0);
  EXPECT_THROW(median_ci95({}), std::invalid_argument);
}

// At counts that nobody chose, its nominal level. 10000 trials scatter by 0.0017.
TEST(Statistics, MedianIntervalHasItsLevel) {
  const auto interval = [](const auto& s, uint64_t) { return median_ci95(s); };
  const double log2 = std::log(2);
  for (const int n : {7, 8, 16, 33, 64, 200}) {
    EXPECT_NEAR(coverage(10000, n, 5, std::normal_distribution<double>(5, 1), interval), 0.97, 0.006) << n;
    EXPECT_NEAR(coverage(10000, n, log2, std::exponential_distribution<double>(1), interval), 0.97, 0.006)
        << n;
  }
}

TEST(Statistics, BootstrapIntervalsNarrowAsTheRootOfTheCount) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(100, 1);
  const auto mean_width = [&](int n) {
    double sum = 0;
    for (int t = 0; t < 100; ++t) {
      std::vector<double> samples(static_cast<size_t>(n));
      for (double& s : samples) s = normal(random);
      sum += bootstrap_median_ci95(samples).width() / 100;
    }
    return sum;
  };
  // Asymptotic width 2 · 1.96 · √(π/2) σ/√n.
  EXPECT_NEAR(mean_width(100), 0.4913, 0.05);
  EXPECT_NEAR(mean_width(25) / mean_width(400), 4, 0.5);
}

TEST(Statistics, BootstrapIsDeterministicInItsSeed) {
  const std::vector<double> samples = {3, 1, 4, 1.5, 9, 2, 6, 5};
  const Interval a = bootstrap_median_ci95(samples, 200, 5), b = bootstrap_median_ci95(samples, 200, 5);
  EXPECT_EQ(a.lo, b.lo);
  EXPECT_EQ(a.hi, b.hi);
  EXPECT_GE(a.lo, 1);
  EXPECT_LE(a.hi, 9);
  // Every draw of an even count is the mean of two samples: reachable values only.
  MedianBootstrap bootstrap(std::vector<double>{1, 3}, 1);
  bool low = false, mixed = false, high = false;
  for (int i = 0; i < 100; ++i) {
    const double m = bootstrap.draw();
    ASSERT_TRUE(m == 1 || m == 2 || m == 3) << m;
    low |= m == 1;
    mixed |= m == 2;
    high |= m == 3;
  }
  EXPECT_TRUE(low && mixed && high);
}

TEST(Statistics, SummaryKeepsTheSamplesInOrder) {
  const Summary s = summarize({5, 1, 3});
  EXPECT_EQ(s.samples, (std::vector<double>{5, 1, 3}));
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.q1, 2);
  EXPECT_EQ(s.q3, 4);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_TRUE(s.ci95.contains(3));
  const Summary one = summarize({2.5});
  EXPECT_EQ(one.ci95.width(), 0);
}

TEST(Statistics, RefusesNothingAndNaN) {
  EXPECT_THROW(summarize({}), std::invalid_argument);
  EXPECT_THROW(summarize({1, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(mean_ci95({}), std::invalid_argument);
  EXPECT_THROW(quantile_sorted({}, 0.5), std::invalid_argument);
  EXPECT_THROW(bootstrap_median_ci95({}), std::invalid_argument);
}
