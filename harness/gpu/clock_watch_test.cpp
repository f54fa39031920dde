#include "gpu/clock_watch.h"

#include <gtest/gtest.h>

namespace vsglbench {
namespace {

const std::string kDevice = "00112233445566778899aabbccddeeff";

TEST(ClockWatch, ReadsWhatTheLibraryTells) {
  const ClockWatch watch(kDevice, VSGLBENCH_MADE_NVML);
  EXPECT_EQ(watch.missing(), "");
  const auto reading = watch.read();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->sm_mhz, 1980u);
  EXPECT_EQ(reading->memory_mhz, 3201u);
  EXPECT_EQ(reading->celsius, 0u);  // the library does not say
  EXPECT_DOUBLE_EQ(reading->watts, 412.5);
  EXPECT_EQ(reading->power_state, "P2");
  EXPECT_EQ(reading->throttled_by, (std::vector<std::string>{"power cap", "hot (hardware)"}));
}

TEST(ClockWatch, ADeviceThatItDoesNotKnowHasNoReadings) {
  std::string other = kDevice;
  other.back() = '0';
  for (const std::string& uuid : {other, std::string(), std::string("short")}) {
    const ClockWatch watch(uuid, VSGLBENCH_MADE_NVML);
    EXPECT_FALSE(watch.read()) << uuid;
    EXPECT_NE(watch.missing().find("does not know the device"), std::string::npos);
  }
}

TEST(ClockWatch, TellsTheUuidOfAnIndex) {
  EXPECT_EQ(nvml_uuid_of(3, VSGLBENCH_MADE_NVML), kDevice);
  EXPECT_FALSE(nvml_uuid_of(0, VSGLBENCH_MADE_NVML));
  EXPECT_FALSE(nvml_uuid_of(3, "libabsent.so.1"));
}

TEST(ClockWatch, NothingDependsOnTheLibrary) {
  const ClockWatch watch(kDevice, "libabsent.so.1");
  EXPECT_FALSE(watch.read());
  EXPECT_EQ(watch.missing(), "libabsent.so.1 is not there");
}

TEST(ClockWatch, ClocksThatWereSetOrAreIdleAreNotThrottled) {
  EXPECT_TRUE(throttle_reasons(0x1 | 0x2).empty());
  EXPECT_EQ(throttle_reasons(0x20).size(), 1u);
}

}  // namespace
}  // namespace vsglbench
