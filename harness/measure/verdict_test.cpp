#include "measure/verdict.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using namespace vsglbench;

namespace {

// n log-normal times round `median` with relative spread `sigma`.
std::vector<double> times(std::mt19937_64& random, size_t n, double median, double sigma) {
  std::lognormal_distribution<double> law(std::log(median), sigma);
  std::vector<double> out(n);
  for (double& t : out) t = law(random);
  return out;
}

}  // namespace

TEST(Verdict, RatioOfMedians) {
  const Ratio r = median_ratio(std::vector<double>{3, 2, 4}, std::vector<double>{2, 1.5, 9});
  EXPECT_DOUBLE_EQ(r.value, 1.5);
  EXPECT_LE(r.ci95.lo, 1.5);
  EXPECT_GE(r.ci95.hi, 1.5);
  EXPECT_THROW(median_ratio(std::vector<double>{0.0}, std::vector<double>{1.0}), std::invalid_argument);
  EXPECT_THROW(median_ratio({}, std::vector<double>{1.0}), std::invalid_argument);
}

TEST(Verdict, TheNoiseFloorIsTheFarEndOfTheInterval) {
  EXPECT_DOUBLE_EQ(noise_floor({1, {0.98, 1.01}}), 1 / 0.98 - 1);
  EXPECT_DOUBLE_EQ(noise_floor({1, {0.999, 1.05}}), 1.05 - 1);
}

TEST(Verdict, ClearDifferencesAreNamed) {
  std::mt19937_64 random(1);
  const auto fast = times(random, 40, 10, 0.02), slow = times(random, 40, 12, 0.02);
  EXPECT_EQ(compare_times(fast, slow, 0.01), Verdict::faster);
  EXPECT_EQ(compare_times(slow, fast, 0.01), Verdict::slower);
  EXPECT_EQ(compare_times(fast, fast, 0.01), Verdict::ambiguous);
}

TEST(Verdict, ADifferenceUnderTheFloorIsAmbiguous) {
  std::mt19937_64 random(2);
  const auto a = times(random, 40, 10, 0.005), b = times(random, 40, 10.5, 0.005);
  EXPECT_EQ(compare_times(a, b, 0.01), Verdict::faster);
  EXPECT_EQ(compare_times(a, b, 0.08), Verdict::ambiguous);
  EXPECT_EQ(compare_times(b, a, 0.08), Verdict::ambiguous);
}

TEST(Verdict, OverlappingIntervalsAreAmbiguous) {
  std::mt19937_64 random(3);
  EXPECT_EQ(compare_times(times(random, 8, 10, 0.3), times(random, 8, 10.5, 0.3), 0), Verdict::ambiguous);
}

TEST(Verdict, EqualLawsAreSeldomToldApart) {
  std::mt19937_64 random(4);
  int wrong = 0, right = 0;
  for (int i = 0; i < 400; ++i) {
    const auto a = times(random, 20, 10, 0.1), b = times(random, 20, 10, 0.1), c = times(random, 20, 15, 0.1);
    wrong += compare_times(a, b, 0, static_cast<uint64_t>(i)) != Verdict::ambiguous;
    right += compare_times(a, c, 0, static_cast<uint64_t>(i)) == Verdict::faster;
  }
  EXPECT_LE(wrong, 12);  // two intervals that must clear each other err in well under 5 % of A/A pairs
  EXPECT_EQ(right, 400);
}
