// What each physical device is and lacks: all missing features are listed at once.
#include "gpu/device_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "gpu/check.h"

namespace vsglbench {
namespace {

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    default:
      return "other";
  }
}

std::string version_text(uint32_t v) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(v), VK_API_VERSION_MINOR(v), VK_API_VERSION_PATCH(v));
}

}  // namespace

NeededFeatures::NeededFeatures() {
  features.pNext = &vulkan11;
  vulkan11.pNext = &vulkan12;
  vulkan12.pNext = &vulkan13;
}

std::vector<NeededFeatures::Entry> NeededFeatures::entries() {
  return {
      {"geometryShader", &features.features.geometryShader},  // gl_PrimitiveID in fragment shaders
      {"shaderInt64", &features.features.shaderInt64},
      {"independentBlend", &features.features.independentBlend},
      {"scalarBlockLayout", &vulkan12.scalarBlockLayout},
      {"bufferDeviceAddress", &vulkan12.bufferDeviceAddress},
      {"hostQueryReset", &vulkan12.hostQueryReset},
      {"dynamicRendering", &vulkan13.dynamicRendering},
      {"synchronization2", &vulkan13.synchronization2},
      {"maintenance4", &vulkan13.maintenance4},
  };
}

std::vector<NeededFeatures::Entry> NeededFeatures::optional_entries() {
  return {
      {"shaderFloat64", &features.features.shaderFloat64},
      {"shaderInt16", &features.features.shaderInt16},
      {"shaderFloat16", &vulkan12.shaderFloat16},
      {"shaderInt8", &vulkan12.shaderInt8},
      {"storageBuffer16BitAccess", &vulkan11.storageBuffer16BitAccess},
      {"storageBuffer8BitAccess", &vulkan12.storageBuffer8BitAccess},
      {"shaderBufferInt64Atomics", &vulkan12.shaderBufferInt64Atomics},
      {"shaderSharedInt64Atomics", &vulkan12.shaderSharedInt64Atomics},
      {"shaderSubgroupExtendedTypes", &vulkan12.shaderSubgroupExtendedTypes},
      {"subgroupSizeControl", &vulkan13.subgroupSizeControl},
      {"computeFullSubgroups", &vulkan13.computeFullSubgroups},
  };
}

std::vector<std::string> optional_features(VkPhysicalDevice device) {
  std::vector<std::string> names;
  NeededFeatures has;
  vkGetPhysicalDeviceFeatures2(device, &has.features);
  for (const auto& entry : has.optional_entries()) {
    if (*entry.flag) names.push_back(entry.name);
  }
  VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup};
  vkGetPhysicalDeviceProperties2(device, &properties);
  if (!(subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT)) return names;
  constexpr std::pair<VkSubgroupFeatureFlagBits, const char*> kinds[] = {
      {VK_SUBGROUP_FEATURE_BASIC_BIT, "subgroup.basic"},
      {VK_SUBGROUP_FEATURE_VOTE_BIT, "subgroup.vote"},
      {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "subgroup.arithmetic"},
      {VK_SUBGROUP_FEATURE_BALLOT_BIT, "subgroup.ballot"},
      {VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "subgroup.shuffle"},
      {VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT, "subgroup.shuffle_relative"},
      {VK_SUBGROUP_FEATURE_CLUSTERED_BIT, "subgroup.clustered"},
      {VK_SUBGROUP_FEATURE_QUAD_BIT, "subgroup.quad"}};
  for (const auto& [bit, name] : kinds) {
    if (subgroup.supportedOperations & bit) names.push_back(name);
  }
  return names;
}

int find_queue_family(VkPhysicalDevice device, uint32_t* timestamp_bits) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (uint32_t i = 0; i < count; ++i) {
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    if ((families[i].queueFlags & wanted) == wanted) {
      *timestamp_bits = families[i].timestampValidBits;
      return static_cast<int>(i);
    }
  }
  return -1;
}

std::vector<std::string> missing_features(VkPhysicalDevice device) {
  std::vector<std::string> missing;
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_3) {
    return {fmt::format("Vulkan 1.3 (has {})", version_text(properties.apiVersion))};
  }
  NeededFeatures has;
  vkGetPhysicalDeviceFeatures2(device, &has.features);
  for (const auto& entry : has.entries()) {
    if (!*entry.flag) missing.push_back(entry.name);
  }
  uint32_t bits = 0;
  if (find_queue_family(device, &bits) < 0) missing.push_back("a queue with graphics and compute");
  if (bits == 0) missing.push_back("timestamps on the graphics and compute queue");
  if (properties.limits.maxPushConstantsSize < 128) missing.push_back("128 bytes of push constants");
  return missing;
}

namespace {

// "0000:3b:00.0", as lspci and nvidia-smi write it.
std::string pci_address(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  const auto is_bus_info = [](const VkExtensionProperties& e) {
    return std::string_view(e.extensionName) == VK_EXT_PCI_BUS_INFO_EXTENSION_NAME;
  };
  if (std::ranges::none_of(extensions, is_bus_info)) return "";
  VkPhysicalDevicePCIBusInfoPropertiesEXT pci{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PCI_BUS_INFO_PROPERTIES_EXT};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &pci};
  vkGetPhysicalDeviceProperties2(device, &properties);
  return fmt::format("{:04x}:{:02x}:{:02x}.{:x}", pci.pciDomain, pci.pciBus, pci.pciDevice, pci.pciFunction);
}

// The named devices, by index.
std::string listed(const std::vector<const DeviceInfo*>& devices) {
  std::string text;
  for (const DeviceInfo* d : devices) {
    text += fmt::format("{}{}: {} (UUID {}{}{})", text.empty() ? "" : ", ", d->index, d->name, d->uuid,
                        d->pci.empty() ? "" : ", PCI ", d->pci);
  }
  return text;
}

}  // namespace

const DeviceInfo& select_device(const std::vector<DeviceInfo>& devices, const std::string& select) {
  if (devices.empty())
    throw fail(ErrorKind::device, "no Vulkan device; install a driver (mesa-vulkan-drivers)");
  std::vector<const DeviceInfo*> all, named;
  for (const DeviceInfo& d : devices) {
    all.push_back(&d);
    if (select == std::to_string(d.index) || select == d.uuid || (!select.empty() && select == d.pci))
      return d;
    const bool fits = select.empty() ? d.missing.empty() : d.name.find(select) != std::string::npos;
    if (fits) named.push_back(&d);
  }
  if (select.empty()) {
    const auto is_gpu = [](const DeviceInfo* d) { return d->type != "cpu"; };
    const auto gpu = std::ranges::find_if(named, is_gpu);
    return gpu != named.end() ? **gpu : named.empty() ? devices.front() : *named.front();
  }
  if (named.empty()) throw fail(ErrorKind::device, "no device '{}'; known: {}", select, listed(all));
  if (named.size() > 1) {
    throw fail(ErrorKind::device, "'{}' is part of {} devices' names; give an index, UUID or PCI address: {}",
               select, named.size(), listed(named));
  }
  return *named.front();
}

DeviceInfo describe_device(VkPhysicalDevice device, uint32_t index) {
  VkPhysicalDeviceVulkan12Properties vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
  VkPhysicalDeviceVulkan11Properties vulkan11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
                                              &vulkan12};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &vulkan11};
  vkGetPhysicalDeviceProperties2(device, &properties);
  const auto& p = properties.properties;
  DeviceInfo info;
  info.index = index;
  info.name = p.deviceName;
  info.type = type_name(p.deviceType);
  for (const uint8_t byte : vulkan11.deviceUUID) info.uuid += fmt::format("{:02x}", byte);
  info.pci = pci_address(device);
  info.driver = vulkan12.driverName;
  info.driver_version = vulkan12.driverInfo;
  info.api = version_text(p.apiVersion);
  info.subgroup_size = vulkan11.subgroupSize;
  info.timestamp_period_ns = p.limits.timestampPeriod;
  info.max_storage_range = p.limits.maxStorageBufferRange;
  info.max_image_dimension = p.limits.maxImageDimension2D;
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) {
      info.memory_bytes = std::max<uint64_t>(info.memory_bytes, memory.memoryHeaps[i].size);
    }
  }
  find_queue_family(device, &info.timestamp_valid_bits);
  info.missing = missing_features(device);
  if (info.missing.empty()) info.features = optional_features(device);
  return info;
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
  uint32_t count = 0;
  VK_CHECK(vkEnumeratePhysicalDevices(instance, &count, nullptr));
  std::vector<VkPhysicalDevice> devices(count);
  VK_CHECK(vkEnumeratePhysicalDevices(instance, &count, devices.data()));
  return devices;
}

}  // namespace vsglbench
