#include "figure/model_times.h"

#include <gtest/gtest.h>

#include "figure/sgl22.h"

namespace vsglbench::sgl22 {
namespace {

using enum exact::DiffuseModel;

// Nine times within 1 % of `ms`.
std::vector<double> around(double ms) {
  std::vector<double> times;
  for (int i = -4; i <= 4; ++i) times.push_back(ms * (1 + 0.0025 * i));
  return times;
}

ModelTimes times(double meder, double ours, double twin) {
  std::vector<std::vector<double>> ms(kModels, around(10));
  ms[static_cast<size_t>(meder_bruederlin)] = around(meder);
  ms[static_cast<size_t>(tokuyoshi2022)] = around(ours);
  return {ms, around(twin)};
}

}  // namespace

TEST(ModelTimes, ADifferenceHasThreeOutcomes) {
  const auto ours_faster = [](double meder, double ours, double twin) {
    return times(meder, ours, twin).faster(tokuyoshi2022, meder_bruederlin);
  };
  EXPECT_EQ(ours_faster(10, 9, 9), Finding::holds);
  EXPECT_EQ(ours_faster(9, 10, 10), Finding::does_not_hold);
  EXPECT_EQ(ours_faster(10, 9.99, 9.99), Finding::undecided);  // the intervals overlap
  EXPECT_EQ(ours_faster(10, 9, 10), Finding::undecided);       // the same model differs by as much
  EXPECT_EQ(ours_faster(10, 0, 10), Finding::undecided);       // no time at all
}

TEST(ModelTimes, FiguresShowIntervalsAndNoise) {
  const std::string text = times(10, 9, 9).figures({tokuyoshi2022});
  EXPECT_TRUE(text.starts_with("tokuyoshi2022 9 ms, 95 % [8.")) << text;
  EXPECT_NE(text.find("A/A noise "), text.npos) << text;
}

TEST(ModelTimes, BothHoldOnlyTogether) {
  EXPECT_EQ(both(Finding::holds, Finding::holds), Finding::holds);
  EXPECT_EQ(both(Finding::holds, Finding::undecided), Finding::undecided);
  EXPECT_EQ(both(Finding::undecided, Finding::does_not_hold), Finding::does_not_hold);
}

}  // namespace vsglbench::sgl22
