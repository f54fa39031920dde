#include "run/scene_clocks.h"

#include <gtest/gtest.h>

namespace vsglbench {
namespace {

TEST(SceneClocks, ReadingsAddUp) {
  std::optional<ClockReport> report;
  add_reading({.sm_mhz = 1980, .memory_mhz = 3201, .celsius = 60, .watts = 500, .power_state = "P0"},
              &report);
  add_reading({.sm_mhz = 1200,
               .memory_mhz = 3201,
               .celsius = 71,
               .watts = 300,
               .power_state = "P0",
               .throttled_by = {"power cap"}},
              &report);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->readings, 2u);
  EXPECT_EQ(report->least_sm_mhz, 1200u);
  EXPECT_EQ(report->most_sm_mhz, 1980u);
  EXPECT_EQ(report->least_memory_mhz, 3201u);
  EXPECT_EQ(report->most_celsius, 71u);
  EXPECT_EQ(report->most_watts, 500);
  EXPECT_EQ(report->power_states, std::vector<std::string>{"P0"});
  EXPECT_EQ(report->throttled_by, std::vector<std::string>{"power cap"});
}

TEST(SceneClocks, WithoutALibraryThereIsNoReport) {
  SceneClocks clocks("", {});
  clocks.look();
  EXPECT_FALSE(clocks.report());
}

}  // namespace
}  // namespace vsglbench
