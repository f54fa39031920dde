#include "measure/creep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace vsglbench;

namespace {

// Figures that scatter by `sigma` round a level that goes from 1 to `end` between two of them.
std::vector<double> drift(uint64_t seed, size_t n, double end, double sigma, size_t from, size_t to) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> law(0, sigma);
  std::vector<double> out;
  for (size_t i = 0; i < n; ++i) {
    const double share = i <= from ? 0 : i >= to ? 1 : double(i - from) / double(to - from);
    out.push_back(std::exp(share * std::log(end) + law(random)));
  }
  return out;
}

}  // namespace

TEST(Creep, ADriftFarBelowTheNoiseOfEachStepIsFoundBothWays) {
  // 6 % over 100 reports: 0.06 % a step, with 0.5 % of scatter and 1 % of A/A noise.
  for (const double end : {1.06, 1 / 1.06}) {
    const auto figures = drift(1, 100, end, 0.005, 0, 99);
    const auto creep = creep_of(figures, 0.01);
    ASSERT_TRUE(creep) << end;
    // The ends' middles are at the reports 7 and 92.
    EXPECT_NEAR(creep->ratio.value, std::pow(end, 85.0 / 99), 0.004) << end;
    EXPECT_LE(creep->ratio.ci95.lo, creep->ratio.value);
    EXPECT_GE(creep->ratio.ci95.hi, creep->ratio.value);
    EXPECT_NEAR(double(creep->from), 7 + 85 / 4.0, 8) << end;
    EXPECT_NEAR(double(creep->to), 7 + 85 * 3 / 4.0, 8) << end;
  }
}

TEST(Creep, ALateDriftAfterALongCalmIsFound) {
  const auto figures = drift(2, 300, 1.05, 0.005, 270, 290);
  const auto creep = creep_of(figures, 0.01);
  ASSERT_TRUE(creep);
  EXPECT_NEAR(creep->ratio.value, 1.05, 0.006);
  EXPECT_NEAR(double(creep->from), 275, 5);
  EXPECT_NEAR(double(creep->to), 285, 5);
}

TEST(Creep, NoiseAloneIsNone) {
  // Far larger than what the A/A pair says, which is nothing. Of 100,000 stretches 0.3 are expected.
  std::mt19937_64 random(7);
  std::normal_distribution<double> law(0, 0.03);
  size_t found = 0;
  for (int k = 0; k < 100'000; ++k) {
    std::vector<double> figures(40);
    for (double& v : figures) v = std::exp(law(random));
    found += creep_of(figures, 0).has_value() ? 1 : 0;
  }
  EXPECT_LE(found, 2);
}

TEST(Creep, ADriftWithinTheNoiseOrOneThatCameBackIsNone) {
  EXPECT_FALSE(creep_of(drift(3, 100, 1.02, 0.001, 0, 99), 0.03));
  auto there = drift(4, 60, 1.06, 0.001, 10, 50), back = there;
  there.insert(there.end(), back.rbegin(), back.rend());
  EXPECT_TRUE(creep_of(back, 0.01));
  EXPECT_FALSE(creep_of(there, 0.01));
}

TEST(Creep, OneFigureOfEachEndMayBeAstrayNotTwo) {
  auto figures = drift(5, 80, 1.06, 0.001, 10, 70);
  figures[3] = 1.5;
  figures[77] = 0.5;
  EXPECT_TRUE(creep_of(figures, 0.01));
  figures[5] = 1.5;
  EXPECT_FALSE(creep_of(figures, 0.01));
}

TEST(Creep, AShortStretchOrAFigureOfZeroIsNone) {
  const auto figures = drift(6, 2 * kCreepEnd, 1.2, 0.001, 0, 2 * kCreepEnd);
  EXPECT_TRUE(creep_of(figures, 0.01));
  EXPECT_FALSE(creep_of(std::span(figures).first(2 * kCreepEnd - 1), 0.01));
  auto zero = figures;
  zero[15] = 0;
  EXPECT_FALSE(creep_of(zero, 0.01));
}
