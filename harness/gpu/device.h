// The Vulkan 1.3 device: what it can do, one queue, one command pool.
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vsglbench {

struct DeviceInfo {
  uint32_t index = 0;
  std::string name, type;  // type: cpu, integrated, discrete, virtual, other
  std::string uuid, pci;   // 32 hex digits; "0000:3b:00.0", empty where the device has no such address
  std::string driver, driver_version, api;
  uint32_t subgroup_size = 0;
  float timestamp_period_ns = 0;
  uint32_t timestamp_valid_bits = 0;
  uint64_t max_storage_range = 0, memory_bytes = 0;
  uint32_t max_image_dimension = 0;
  std::vector<std::string> features;  // optional ones that it has, which a method may ask for
  std::vector<std::string> missing;   // needed features and extensions that it lacks; empty = usable
};

// Every physical device the loader shows; empty when there is none. Throws Error(device) when the loader
// itself fails.
std::vector<DeviceInfo> list_devices();

// Which of `devices` is meant by an index, a UUID, a PCI address, or a part of a name that no other device
// has; empty: the first usable, GPUs before CPUs. Throws Error(device).
const DeviceInfo& select_device(const std::vector<DeviceInfo>& devices, const std::string& select);

struct DeviceOptions {
  std::string select;       // as in select_device()
  bool validation = false;  // Khronos validation layer with synchronisation checks
};

// Owns instance, device, queue and command pool. Move is not needed: use through a reference.
class Device {
 public:
  // Throws Error(device): no device, none selected, or each missing feature by name.
  explicit Device(const DeviceOptions& options = {});
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  bool is_cpu() const { return info_.type == "cpu"; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  VkCommandPool command_pool() const { return pool_; }
  VkSampler sampler() const { return sampler_; }  // bilinear, repeat, finest level only
  uint32_t memory_type(uint32_t allowed_bits, VkMemoryPropertyFlags wanted) const;

  // Records with `record`, submits, waits. For uploads and downloads, never timed.
  void run_once(const std::function<void(VkCommandBuffer)>& record);

  // Gives a Vulkan object the name that validation messages and captures show.
  void name_object(VkObjectType type, uint64_t handle, const std::string& name) const;

  // Warnings and errors of the validation layers so far, synchronisation hazards included.
  const std::vector<std::string>& validation_messages() const { return messages_; }

  // Bytes of device memory allocated and not yet given back.
  uint64_t allocated_bytes() const { return allocated_; }
  void count_memory(int64_t bytes) { allocated_ += static_cast<uint64_t>(bytes); }

  PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;

 private:
  void create_instance(bool validation);
  void pick(const std::string& select);
  void create_device();
  static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT*, void* self);

  DeviceInfo info_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  uint64_t allocated_ = 0;
  VkPhysicalDeviceMemoryProperties memory_{};
  std::vector<std::string> messages_;
  PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
};

}  // namespace vsglbench
