#include <gtest/gtest.h>

#include "base/error.h"
#include "gpu/device.h"

namespace vsglbench {
namespace {

// A CPU, two equal GPUs, and one that lacks something.
std::vector<DeviceInfo> devices() {
  std::vector<DeviceInfo> all(4);
  const char* names[] = {"llvmpipe", "H200", "H200", "Old GPU"};
  for (uint32_t i = 0; i < 4; ++i) {
    all[i].index = i;
    all[i].name = names[i];
    all[i].type = i == 0 ? "cpu" : "discrete";
    all[i].uuid = std::string(31, 'a') + std::to_string(i);
    if (i > 0) all[i].pci = "0000:0" + std::to_string(i) + ":00.0";
  }
  all[3].missing = {"bufferDeviceAddress"};
  return all;
}

uint32_t selected(const std::string& select) { return select_device(devices(), select).index; }

std::string refusal(const std::string& select) {
  try {
    selected(select);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(SelectDevice, EqualOnesAreToldApart) {
  EXPECT_EQ(selected("2"), 2u);
  EXPECT_EQ(selected("0000:01:00.0"), 1u);
  EXPECT_EQ(selected("0000:02:00.0"), 2u);
  EXPECT_EQ(selected(devices()[2].uuid), 2u);
  EXPECT_EQ(refusal("H200"),
            "'H200' is part of 2 devices' names; give an index, UUID or PCI address: "
            "1: H200 (UUID aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa1, PCI 0000:01:00.0), "
            "2: H200 (UUID aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa2, PCI 0000:02:00.0)");
}

TEST(SelectDevice, ByPartOfANameOrTheFirstUsable) {
  EXPECT_EQ(selected("pipe"), 0u);
  EXPECT_EQ(selected("Old"), 3u);
  EXPECT_EQ(selected(""), 1u);
  EXPECT_EQ(select_device({devices()[3], devices()[0]}, "").index, 0u);
  EXPECT_EQ(select_device({devices()[3]}, "").index, 3u);
  EXPECT_TRUE(refusal("A100").starts_with("no device 'A100'; known: 0: llvmpipe (UUID "));
  EXPECT_TRUE(refusal("9").starts_with("no device '9'"));
  EXPECT_THROW(select_device({}, ""), Error);
}

}  // namespace
}  // namespace vsglbench
