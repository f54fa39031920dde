// Device buffers and 2-D images: move-only, they free themselves.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace vsglbench {

// What watched memory holds until a kernel writes it: a NaN that no arithmetic makes.
inline constexpr uint32_t unwritten_word = 0xFFC0DEADu;

// A storage buffer in device memory (also transfer source and target, vertex, index and uniform buffer). What
// it holds belongs to the device: kernels, fill() and upload() change it through a const reference, too.
class Buffer {
 public:
  Buffer() = default;
  // `guard`: so many bytes more lie behind the end, less where the device's storage-buffer range ends.
  // Kernels have them bound with the rest, so that what is written past the end arrives there and can be
  // seen. Throws Error(case_failed) when `bytes` is over that range or the device's memory.
  Buffer(Device& device, const std::string& name, size_t bytes, size_t guard = 0);
  ~Buffer();
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }

  VkBuffer handle() const { return buffer_; }
  size_t size() const { return size_; }
  size_t guard() const { return guard_; }
  explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }

  // Blocking; `bytes` and `offset` are multiples of 4 and may reach into the guard.
  void fill(uint32_t word, size_t bytes, size_t offset) const;
  // Blocking copies through a staging buffer (or straight, where the memory is host-visible). A download may
  // reach into the guard.
  void upload(const void* data, size_t bytes, size_t offset = 0) const;
  void download(void* data, size_t bytes, size_t offset = 0) const;
  template <class T>
  void upload(std::span<const T> data) const {
    upload(data.data(), data.size_bytes());
  }
  template <class T>
  std::vector<T> download(size_t count) const {
    std::vector<T> out(count);
    download(out.data(), count * sizeof(T));
    return out;
  }

 private:
  void swap(Buffer& other) noexcept;
  Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  void* mapped_ = nullptr;  // lavapipe and integrated GPUs
  size_t size_ = 0, guard_ = 0, allocated_ = 0;
};

// One 2-D image with its view: a render target that kernels read, or a texture.
class DeviceImage {
 public:
  DeviceImage() = default;
  DeviceImage(Device& device, const std::string& name, VkFormat format, uint32_t width, uint32_t height,
              VkImageUsageFlags usage);
  ~DeviceImage();
  DeviceImage(DeviceImage&& other) noexcept { swap(other); }
  DeviceImage& operator=(DeviceImage&& other) noexcept {
    swap(other);
    return *this;
  }

  explicit operator bool() const { return image_ != VK_NULL_HANDLE; }
  VkImage handle() const { return image_; }
  VkImageView view() const { return view_; }
  VkFormat format() const { return format_; }
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  bool is_depth() const { return format_ == VK_FORMAT_D32_SFLOAT; }

  // Uploads tightly packed texels; leaves the image in SHADER_READ_ONLY_OPTIMAL.
  void upload(const void* texels, size_t bytes);
  // Downloads tightly packed texels of an image in SHADER_READ_ONLY_OPTIMAL.
  void download(void* texels, size_t bytes) const;

 private:
  void swap(DeviceImage& other) noexcept;
  Device* device_ = nullptr;
  VkImage image_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  uint32_t width_ = 0, height_ = 0;
  size_t allocated_ = 0;
};

// Records a full image barrier between layouts (all stages, all accesses).
void transition(VkCommandBuffer commands, const DeviceImage& image, VkImageLayout from, VkImageLayout to);

}  // namespace vsglbench
