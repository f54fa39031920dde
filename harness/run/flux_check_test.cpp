#include "run/flux_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vsglbench {
namespace {

MethodInfo stating(double bound, double uneven = -1) {
  MethodInfo info;
  info.flux_bound = bound;
  info.uneven_flux_bound = uneven;
  return info;
}

TEST(FluxCheck, EverySetOfAMethodThatKeepsAllTexelsIsHeldToItsBound) {
  const MethodInfo sums = stating(1e-4);
  EXPECT_EQ(flux_fault(sums, std::vector<double>{1, 0.995, 1.005}), "");
  EXPECT_NE(flux_fault(sums, std::vector<double>{1, 1, 0.9}), "");
  EXPECT_NE(flux_fault(sums, std::vector<double>{1.02}), "");
  EXPECT_NE(flux_fault(sums, std::vector<double>{0}), "");
}

TEST(FluxCheck, WhatIsDrawnIsRefusedWhenAllSetsCarryTooMuch) {
  const MethodInfo drawn = stating(0.05);
  EXPECT_NE(flux_fault(drawn, std::vector<double>(8, 2.1)), "");
  EXPECT_EQ(flux_fault(drawn, std::vector<double>(8, 1.9)), "");
  EXPECT_NE(flux_fault(drawn, std::vector<double>(2, 20)), "");
  EXPECT_EQ(flux_fault(drawn, std::vector<double>(1, 100)), "");
  EXPECT_NE(flux_fault(drawn, std::vector<double>(1, 256)), "");
  // A bound for uneven PDFs counts where it is the wider one.
  EXPECT_EQ(flux_fault(stating(0.05, 0.5), std::vector<double>(8, 2.1)), "");
  // Seven seeds of nearly nothing and one spike, as `vpl` has them on ring514.
  EXPECT_EQ(flux_fault(drawn, std::vector<double>{0.05, 0.03, 0.09, 0.06, 0.04, 0.05, 0.08, 8}), "");
  EXPECT_EQ(flux_fault(drawn, std::vector<double>{0, 300}), "");
}

// Sound light sets of mean 1, from nearly even to one rare light that carries nearly all.
TEST(FluxCheck, SoundSetsAreHardlyEverRefused) {
  std::mt19937_64 random(7);
  const MethodInfo drawn = stating(0.002);
  constexpr int kCases = 20000;
  for (const double rare : {0.9, 0.5, 0.1, 0.01}) {
    int refused = 0;
    for (int i = 0; i < kCases; ++i) {
      std::vector<double> ratios;
      for (int seed = 0; seed < 8; ++seed) {
        ratios.push_back(std::bernoulli_distribution(rare)(random) ? 0.99 / rare + 0.01 : 0.01);
        if (!flux_fault(drawn, ratios).empty()) {
          ++refused;
          break;
        }
      }
    }
    EXPECT_LE(refused, kCases / 200 + 3 * std::sqrt(kCases / 200.0)) << rare;
  }
}

}  // namespace
}  // namespace vsglbench
