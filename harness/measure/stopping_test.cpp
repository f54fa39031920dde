#include "measure/stopping.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

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
  EXPECT_EQ(should_stop(rule, spread(20, 0.001), 0.1), StopReason::converged);
  EXPECT_EQ(should_stop(rule, spread(20, 3), 0.1), std::nullopt);
  EXPECT_EQ(should_stop(rule, spread(9, 0), 0.1), std::nullopt) << "fewer than min_samples";
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
  auto samples = spread(25, 1);  // interval a few units wide at most, round 10
  EXPECT_EQ(should_stop(rule, samples, 0), StopReason::converged);
  for (double& s : samples) s -= 9.5;  // the same width round 0.5
  EXPECT_EQ(should_stop(rule, samples, 0), std::nullopt);
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
