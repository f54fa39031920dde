#include "sweep/device_choice.h"

#include <gtest/gtest.h>

namespace vsglbench {
namespace {

DeviceInfo made(uint32_t index, const std::string& name, const std::string& type, char digit) {
  DeviceInfo d;
  d.index = index;
  d.name = name;
  d.type = type;
  d.uuid = std::string(8, digit) + "00112233445566778899aabb";
  return d;
}

// In another order than CUDA's, which counts by the bus.
std::vector<DeviceInfo> node() {
  return {made(0, "NVIDIA H200", "discrete", 'b'), made(1, "NVIDIA H200", "discrete", 'a'),
          made(2, "llvmpipe", "cpu", 'c')};
}

std::optional<std::string> library(unsigned index) {
  if (index > 1) return std::nullopt;
  return node()[index == 0 ? 1 : 0].uuid;
}
std::optional<std::string> no_library(unsigned) { return std::nullopt; }

uint32_t chosen(const std::optional<std::string>& given, const std::string& require = "",
                const std::string& select = "") {
  return choose_device(node(), {select, given, require}, library).index;
}

std::string wrong(const std::vector<DeviceInfo>& devices, const DeviceWish& wish,
                  const GpuOfIndex& gpus = library) {
  try {
    choose_device(devices, wish, gpus);
  } catch (const WrongDevice& e) {
    return e.what();
  }
  return "";
}

TEST(DeviceChoice, TheGpuOfTheEngineIsFoundByItsUuid) {
  EXPECT_EQ(chosen("0"), 1u);  // Vulkan's first is CUDA's second
  EXPECT_EQ(chosen("1"), 0u);
  EXPECT_EQ(chosen("1,0"), 0u);
  EXPECT_EQ(chosen("GPU-aaaaaaaa-0011-2233-4455-66778899aabb"), 1u);
  EXPECT_EQ(chosen("GPU-BBBB"), 0u);  // CUDA takes the beginning of one
}

TEST(DeviceChoice, WithoutAnEngineItIsThatOfRun) {
  EXPECT_EQ(chosen(std::nullopt), 0u);
  EXPECT_EQ(chosen(std::nullopt, "", "llvmpipe"), 2u);
  EXPECT_EQ(chosen("0", "", "0"), 0u);  // --device is the user's word
}

TEST(DeviceChoice, NoGpuGivenIsNoGpuTaken) {
  for (const char* none : {"", "-1", "NoDevFiles"}) {
    EXPECT_EQ(chosen(none), 2u) << none;
    EXPECT_NE(wrong({node()[0]}, {"", none, ""}), "");
  }
}

TEST(DeviceChoice, AGpuThatVulkanDoesNotKnowIsTheWrongOne) {
  const std::vector<DeviceInfo> without = {node()[0], node()[2]};
  EXPECT_NE(wrong(without, {"", "0", ""}).find("Vulkan doesn't know the GPU of CUDA_VISIBLE_DEVICES=0"),
            std::string::npos);
  EXPECT_NE(wrong({node()[2]}, {"", "1", ""}).find("is its Vulkan driver installed?"), std::string::npos);
  EXPECT_NE(wrong(node(), {"", "GPU-dddddddd-0011-2233-4455-66778899aabb", ""}), "");
  EXPECT_NE(wrong(node(), {"", "GPU-", ""}), "");
  EXPECT_NE(wrong(node(), {"", "MIG-aaaaaaaa-0011-2233-4455-66778899aabb", ""}), "");
  EXPECT_NE(wrong(node(), {"", "first", ""}), "");
}

TEST(DeviceChoice, AnIndexWithoutItsLibraryIsTheOnlyGpu) {
  EXPECT_NE(wrong(node(), {"", "0", ""}, no_library).find("which of 2 GPUs"), std::string::npos);
  const std::vector<DeviceInfo> one = {node()[2], node()[0]}, none = {node()[2]};
  EXPECT_EQ(choose_device(one, {"", "5", ""}, no_library).name, "NVIDIA H200");
  EXPECT_EQ(choose_device(none, {"", "0", ""}, no_library).name, "llvmpipe");
}

TEST(DeviceChoice, AnotherThanTheRequiredOneIsWrong) {
  EXPECT_EQ(chosen("0", "H200"), 1u);
  EXPECT_EQ(chosen("0", "GPU-aaaaaaaa-0011-2233-4455-66778899aabb"), 1u);
  EXPECT_EQ(chosen("0", "aaaaaaaa00112233445566778899aabb"), 1u);
  EXPECT_NE(wrong(node(), {"", "0", "H100"}).find("and 'H100' is required"), std::string::npos);
  EXPECT_NE(wrong(node(), {"llvmpipe", std::nullopt, "H200"}), "");
  EXPECT_NE(wrong(node(), {"", "0", "GPU-bbbbbbbb-0011-2233-4455-66778899aabb"}), "");
  EXPECT_FALSE(is_required("H200", "aa", "a"));
}

TEST(DeviceChoice, NoDeviceAtAllIsNoWrongOne) {
  EXPECT_THROW(choose_device({}, {"", "0", ""}, library), Error);
  EXPECT_EQ(wrong({node()[2]}, {"", std::nullopt, ""}), "");
}

}  // namespace
}  // namespace vsglbench
