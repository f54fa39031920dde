// Inside gpu/ only: queries on physical devices.
#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "gpu/device.h"

namespace vsglbench {

// The chain of feature structs, to query or to enable; entries() names the members that are needed.
struct NeededFeatures {
  struct Entry {
    const char* name;
    VkBool32* flag;
  };
  NeededFeatures();
  NeededFeatures(const NeededFeatures&) = delete;
  NeededFeatures& operator=(const NeededFeatures&) = delete;
  std::vector<Entry> entries();
  // Features that a method may ask for (MethodInfo::device_features); enabled where the device has them.
  std::vector<Entry> optional_entries();

  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan11Features vulkan11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
  VkPhysicalDeviceVulkan12Features vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features vulkan13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
};

// First family with graphics and compute, or -1.
int find_queue_family(VkPhysicalDevice device, uint32_t* timestamp_bits);
std::vector<std::string> missing_features(VkPhysicalDevice device);
// The names in Vulkan of those of optional_entries() that the device has, and `subgroup.<kind>` for each kind
// of subgroup operation that compute shaders may use.
std::vector<std::string> optional_features(VkPhysicalDevice device);
DeviceInfo describe_device(VkPhysicalDevice device, uint32_t index);
std::vector<VkPhysicalDevice> physical_devices(VkInstance instance);

}  // namespace vsglbench
