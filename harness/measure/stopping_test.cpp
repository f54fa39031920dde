#include "measure/stopping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "measure/statistics.h"
#include "measure/stopwatch.h"

using namespace vsglbench;

namespace {

std::vector<double> spread(size_t n, double width) {
  std::vector<double> samples(n);
  for (size_t i = 0; i < n; ++i) samples[i] = 10 + width * (static_cast<double>(i % 5) - 2);
  return samples;
}

}  // namespace

TEST(Stopping, ConvergesOnceTheIntervalIsNarrow) {
  const StoppingRule rule{.relative_width = 0.02, .min_samples = 10, .max_samples = 100, .time_limit_s = 1};
  EXPECT_EQ(should_stop(rule, spread(16, 0.001), 0.1), StopReason::converged);
  EXPECT_EQ(should_stop(rule, spread(16, 3), 0.1), std::nullopt);
  EXPECT_EQ(should_stop(rule, spread(8, 0), 0.1), std::nullopt) << "fewer than min_samples";
  EXPECT_EQ(should_stop(rule, spread(20, 0.001), 0.1), std::nullopt) << "between two looks";
}

TEST(Stopping, LimitsEndWhatDoesNotConverge) {
  const StoppingRule rule{.relative_width = 0.02, .min_samples = 10, .max_samples = 30, .time_limit_s = 1};
  EXPECT_EQ(should_stop(rule, spread(30, 3), 0.1), StopReason::max_samples);
  EXPECT_EQ(should_stop(rule, spread(20, 3), 1.0), StopReason::time_limit);
  EXPECT_EQ(should_stop(rule, spread(2, 3), 5), StopReason::time_limit) << "holds below min_samples";
  EXPECT_EQ(should_stop(rule, {}, 5), std::nullopt) << "one sample at least";
}

TEST(Stopping, TheWidthIsRelativeToTheMedian) {
  const StoppingRule rule{.relative_width = 0.5, .min_samples = 5, .max_samples = 100, .time_limit_s = 1};
  auto samples = spread(32, 1);  // interval a few units wide at most, round 10
  EXPECT_EQ(should_stop(rule, samples, 0), StopReason::converged);
  for (double& s : samples) s -= 9.5;  // the same width round 0.5
  EXPECT_EQ(should_stop(rule, samples, 0), std::nullopt);
}

TEST(Stopping, LooksAtDoubledCounts) {
  std::vector<size_t> looks;
  for (size_t n = 0; n <= 300; ++n) {
    if (looks_at(n)) looks.push_back(n);
  }
  EXPECT_EQ(looks, (std::vector<size_t>{8, 16, 32, 64, 128, 256}));
}

namespace {

// How often the interval that a measurement ends with holds the true median, of times that scatter by 5 %
// about 1.
double coverage(bool every_sample, int trials) {
  constexpr size_t kMost = 128;
  constexpr double kWidth = 0.03;
  std::mt19937_64 random(7);
  std::normal_distribution<> scatter(0, 0.05);
  int held = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> samples;
    Interval ci;
    while (samples.size() < kMost) {
      samples.push_back(std::exp(scatter(random)));
      if (samples.size() < 8 || (!every_sample && !looks_at(samples.size()))) continue;
      ci = bootstrap_median_ci95(samples, 300, static_cast<uint64_t>(trial));
      if (ci.width() < kWidth * median(samples)) break;
    }
    held += ci.contains(1);
  }
  return static_cast<double>(held) / trials;
}

}  // namespace

// 2000 trials scatter by 0.006, 300 by 0.02. No look at all would leave 0.95.
TEST(Stopping, DoubledLooksKeepTheIntervalsCoverage) {
  const double doubled = coverage(false, 2000), every = coverage(true, 300);
  std::printf("coverage of a nominal 95 %% interval: %.3f by doubled looks, %.3f by looks at every sample\n",
              doubled, every);
  EXPECT_GT(doubled, 0.895);
  EXPECT_LT(every, 0.87);
}

TEST(Stopping, ReasonsHaveTheReportsNames) {
  EXPECT_EQ(name(StopReason::converged), "converged");
  EXPECT_EQ(name(StopReason::time_limit), "time_limit");
  EXPECT_EQ(name(StopReason::max_samples), "max_samples");
}

TEST(Stopwatch, CountsWallTime) {
  Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double ms = watch.milliseconds();
  EXPECT_GE(ms, 20);
  watch.restart();
  EXPECT_LT(watch.milliseconds(), ms);
}
