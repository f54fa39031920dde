#include "figure/axis.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace vsglbench;

namespace {

size_t ticks(const LogAxis& axis) {
  const size_t at = axis.commands.find("tics (");
  return at == std::string::npos
             ? 0
             : 1 + static_cast<size_t>(
                       std::count(axis.commands.begin() + static_cast<long>(at), axis.commands.end(), ','));
}

}  // namespace

TEST(LogAxis, HoldsTheValuesAndAMargin) {
  const LogAxis axis = log_axis('x', 2, 30);
  EXPECT_LT(axis.least, 2);
  EXPECT_GT(axis.most, 30);
  EXPECT_NE(axis.commands.find("set logscale x"), std::string::npos);
  const LogAxis point = log_axis('y', 5, 5);
  EXPECT_LT(point.least, 5);
  EXPECT_GT(point.most, 5);
}

// A reader needs three numbers to see that an axis is logarithmic.
TEST(LogAxis, HasTicksHoweverShortItIs) {
  for (const double most : {1.0, 1.001, 1.1, 1.5, 3.0, 9.0, 30.0}) {
    EXPECT_GE(ticks(log_axis('x', 1, most)), 3u) << most;
    EXPECT_GE(ticks(log_axis('x', 0.0137, 0.0137 * most)), 3u) << most;
  }
  EXPECT_NE(log_axis('y', 1, 1000).commands.find("10^{%T}"), std::string::npos);
}
