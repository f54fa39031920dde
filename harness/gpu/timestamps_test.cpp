#include "gpu/timestamps.h"

#include <gtest/gtest.h>

#include <vector>

namespace vsglbench {
namespace {

const TimestampClock kNanoseconds{1e-6, 64};

std::string fault(std::vector<uint64_t> stamps, double wall_ms = 10,
                  const TimestampClock& clock = kNanoseconds) {
  return timestamp_fault(stamps, clock, wall_ms);
}

TEST(Timestamps, TrueOnesPass) {
  EXPECT_EQ(fault({1'000'000, 2'000'000, 2'000'000, 9'000'000}), "");
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({5, 5}), "") << "a pass may take no time that the clock sees";
}

TEST(Timestamps, ImpossibleOnesAreNamed) {
  EXPECT_NE(fault({1'000'000, 0}).find("2 of 2 is 0"), std::string::npos);
  EXPECT_NE(fault({2'000'000, 1'000'000}).find("2 of 2"), std::string::npos) << "backward";
  EXPECT_NE(fault({1, 18'446'744'073'709'551'615u}).find("2 of 2"), std::string::npos);
  EXPECT_NE(fault({1'000'000, 20'000'000}).find("the host waited 10 ms"), std::string::npos);
  EXPECT_NE(fault({1'000'000, 7'000'000, 7'000'000, 13'000'000}).find("span 12 ms"), std::string::npos);
}

TEST(Timestamps, AClockOfFewBitsMayWrapRound) {
  const TimestampClock clock{1e-6, 36};
  const uint64_t end = (uint64_t{1} << 36) - 1;
  EXPECT_EQ(fault({end - 500'000, 500'000}, 10, clock), "");
  EXPECT_DOUBLE_EQ(clock.milliseconds(end, 999'999), 1);
}

}  // namespace
}  // namespace vsglbench
