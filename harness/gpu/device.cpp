#include "gpu/device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "gpu/check.h"
#include "gpu/device_info.h"
#include "gpu/loop_check.h"

namespace vsglbench {

void check_vulkan(VkResult result, const char* call, const char* file, int line) {
  if (result == VK_SUCCESS) return;
  const char* base = std::strrchr(file, '/');
  const char* reason = result == VK_ERROR_DEVICE_LOST            ? "the device was lost"
                       : result == VK_ERROR_OUT_OF_DEVICE_MEMORY ? "out of device memory"
                       : result == VK_ERROR_OUT_OF_HOST_MEMORY   ? "out of host memory"
                                                                 : "failed";
  throw fail(ErrorKind::device_lost, "Vulkan: {} (code {}) in {} at {}:{}", reason, static_cast<int>(result),
             call, base ? base + 1 : file, line);
}

namespace {

// A Vulkan call that fails before there is a device means that none can be opened.
template <class Action>
auto opening(const Action& action) {
  try {
    return action();
  } catch (const Error& e) {
    throw Error(e.kind() == ErrorKind::device_lost ? ErrorKind::device : e.kind(), e.what());
  }
}

VkInstance make_instance(bool validation) {
  const VkApplicationInfo app{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                              .pApplicationName = "vsglbench",
                              .apiVersion = VK_API_VERSION_1_3};
  std::vector<const char*> layers, extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  const VkValidationFeatureEnableEXT enabled[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .enabledValidationFeatureCount = 1,
                                         .pEnabledValidationFeatures = enabled};
  if (validation) {
    layers.push_back("VK_LAYER_KHRONOS_validation");
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = validation ? &features : nullptr,
                                    .pApplicationInfo = &app,
                                    .enabledLayerCount = static_cast<uint32_t>(layers.size()),
                                    .ppEnabledLayerNames = layers.data(),
                                    .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&create, nullptr, &instance);
  if (result == VK_ERROR_LAYER_NOT_PRESENT) {
    throw fail(ErrorKind::device, "the Khronos validation layer is not installed (vulkan-validationlayers)");
  }
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw fail(ErrorKind::device, "no Vulkan driver found; install one (mesa-vulkan-drivers has lavapipe)");
  }
  VK_CHECK(result);
  return instance;
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
  const VkInstance instance = opening([] { return make_instance(false); });
  std::vector<DeviceInfo> out;
  for (const VkPhysicalDevice device : physical_devices(instance)) {
    out.push_back(describe_device(device, static_cast<uint32_t>(out.size())));
  }
  vkDestroyInstance(instance, nullptr);
  return out;
}

Device::Device(const DeviceOptions& options) {
  opening([&] {
    create_instance(options.validation);
    pick(options.select);
    create_device();
    LoopCheck::create(*this);
  });
}

Device::~Device() {
  if (device_) {
    vkDeviceWaitIdle(device_);
    LoopCheck::destroy(*this);
    vkDestroySampler(device_, sampler_, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  if (instance_) vkDestroyInstance(instance_, nullptr);
}

void Device::create_instance(bool validation) {
  instance_ = make_instance(validation);
  if (!validation) return;
  const VkDebugUtilsMessengerCreateInfoEXT create{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
      .pfnUserCallback = &Device::on_message,
      .pUserData = this};
  const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  VK_CHECK(make(instance_, &create, nullptr, &messenger_));
}

VkBool32 Device::on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
  static_cast<Device*>(self)->messages_.push_back(data->pMessage);
  return VK_FALSE;
}

void Device::pick(const std::string& select) {
  const auto devices = physical_devices(instance_);
  std::vector<DeviceInfo> infos;
  for (const VkPhysicalDevice device : devices) {
    infos.push_back(describe_device(device, static_cast<uint32_t>(infos.size())));
  }
  const DeviceInfo* chosen = &select_device(infos, select);
  if (!chosen->missing.empty()) {
    throw fail(ErrorKind::device, "{} lacks {}", chosen->name, fmt::join(chosen->missing, ", "));
  }
  info_ = *chosen;
  physical_ = devices[info_.index];
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
}

void Device::create_device() {
  uint32_t bits = 0;
  family_ = static_cast<uint32_t>(find_queue_family(physical_, &bits));
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = family_,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  NeededFeatures features;
  for (const auto& entry : features.entries()) *entry.flag = VK_TRUE;
  const auto has = [&](const char* name) { return std::ranges::count(info_.features, name) > 0; };
  for (const auto& entry : features.optional_entries()) *entry.flag = has(entry.name) ? VK_TRUE : VK_FALSE;
  const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.features,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue};
  VK_CHECK(vkCreateDevice(physical_, &create, nullptr, &device_));
  vkGetDeviceQueue(device_, family_, 0, &queue_);
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                     .queueFamilyIndex = family_};
  VK_CHECK(vkCreateCommandPool(device_, &pool, nullptr, &pool_));
  const VkSamplerCreateInfo sampler{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                    .magFilter = VK_FILTER_LINEAR,
                                    .minFilter = VK_FILTER_LINEAR,
                                    .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                    .addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                    .addressModeV = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                    .addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                    .maxLod = 0};
  VK_CHECK(vkCreateSampler(device_, &sampler, nullptr, &sampler_));
  const auto instance_function = [&](const char* name) { return vkGetInstanceProcAddr(instance_, name); };
  begin_label =
      reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(instance_function("vkCmdBeginDebugUtilsLabelEXT"));
  end_label =
      reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(instance_function("vkCmdEndDebugUtilsLabelEXT"));
  set_name_ =
      reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(instance_function("vkSetDebugUtilsObjectNameEXT"));
}

uint32_t Device::memory_type(uint32_t allowed_bits, VkMemoryPropertyFlags wanted) const {
  for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    if ((allowed_bits & (1u << i)) && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  throw fail(ErrorKind::device, "{}: no memory type with properties {:#x}", info_.name, wanted);
}

void Device::run_once(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool_,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VK_CHECK(vkAllocateCommandBuffers(device_, &allocate, &commands));
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  VK_CHECK(vkBeginCommandBuffer(commands, &begin));
  record(commands);
  VK_CHECK(vkEndCommandBuffer(commands));
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  VK_CHECK(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE));
  VK_CHECK(vkQueueWaitIdle(queue_));
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
}

void Device::name_object(VkObjectType type, uint64_t handle, const std::string& name) const {
  if (!set_name_) return;
  const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                           .objectType = type,
                                           .objectHandle = handle,
                                           .pObjectName = name.c_str()};
  set_name_(device_, &info);
}

}  // namespace vsglbench
