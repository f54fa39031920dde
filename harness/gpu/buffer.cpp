#include "gpu/buffer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "gpu/check.h"

namespace vsglbench {
namespace {

VkDeviceMemory allocate(Device& device, const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags,
                        const std::string& name) {
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .allocationSize = needs.size,
                                  .memoryTypeIndex = device.memory_type(needs.memoryTypeBits, flags)};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult result = vkAllocateMemory(device.handle(), &info, nullptr, &memory);
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
    throw fail(ErrorKind::case_failed, "{}: {} MiB do not fit into the device's memory ({} MiB in use)", name,
               needs.size >> 20, device.allocated_bytes() >> 20);
  }
  VK_CHECK(result);
  device.count_memory(static_cast<int64_t>(needs.size));
  return memory;
}

VkBuffer make_buffer(Device& device, size_t bytes, VkBufferUsageFlags usage) {
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
  VkBuffer buffer = VK_NULL_HANDLE;
  VK_CHECK(vkCreateBuffer(device.handle(), &info, nullptr, &buffer));
  return buffer;
}

constexpr VkMemoryPropertyFlags kHost =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// A host-visible buffer that lives for one copy.
struct Staging {
  Device& device;
  VkBuffer buffer;
  VkDeviceMemory memory;
  size_t bytes;
  void* mapped = nullptr;
  Staging(Device& d, size_t size)
      : device(d),
        buffer(make_buffer(d, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT)) {
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(d.handle(), buffer, &needs);
    memory = allocate(d, needs, kHost, "staging buffer");
    bytes = needs.size;
    VK_CHECK(vkBindBufferMemory(d.handle(), buffer, memory, 0));
    VK_CHECK(vkMapMemory(d.handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped));
  }
  ~Staging() {
    vkDestroyBuffer(device.handle(), buffer, nullptr);
    vkFreeMemory(device.handle(), memory, nullptr);
    device.count_memory(-static_cast<int64_t>(bytes));
  }
};

}  // namespace

Buffer::Buffer(Device& device, const std::string& name, size_t bytes, size_t guard)
    : device_(&device), size_(bytes < 16 ? 16 : bytes) {
  if (size_ > device.info().max_storage_range) {
    throw fail(ErrorKind::case_failed, "{}: {} MiB are over the device's storage-buffer range of {} MiB",
               name, size_ >> 20, device.info().max_storage_range >> 20);
  }
  guard_ = std::min<size_t>(guard, device.info().max_storage_range - size_);
  buffer_ = make_buffer(device, size_ + guard_,
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                            VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
  const VkMemoryPropertyFlags flags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | (device.is_cpu() ? kHost : 0);
  try {
    memory_ = allocate(device, needs, flags, name);
  } catch (...) {
    vkDestroyBuffer(device.handle(), buffer_, nullptr);
    throw;
  }
  allocated_ = needs.size;
  VK_CHECK(vkBindBufferMemory(device.handle(), buffer_, memory_, 0));
  if (device.is_cpu()) VK_CHECK(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_));
  device.name_object(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer_), name);
}

Buffer::~Buffer() {
  if (!buffer_) return;
  vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  vkFreeMemory(device_->handle(), memory_, nullptr);
  device_->count_memory(-static_cast<int64_t>(allocated_));
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(mapped_, other.mapped_);
  std::swap(size_, other.size_);
  std::swap(guard_, other.guard_);
  std::swap(allocated_, other.allocated_);
}

void Buffer::upload(const void* data, size_t bytes, size_t offset) const {
  if (offset + bytes > size_) throw std::logic_error("Buffer::upload past the end");
  if (bytes == 0) return;
  if (mapped_) {
    std::memcpy(static_cast<char*>(mapped_) + offset, data, bytes);
    return;
  }
  Staging staging(*device_, bytes);
  std::memcpy(staging.mapped, data, bytes);
  device_->run_once([&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, offset, bytes};
    vkCmdCopyBuffer(commands, staging.buffer, buffer_, 1, &region);
  });
}

void Buffer::fill(uint32_t word, size_t bytes, size_t offset) const {
  if (offset + bytes > size_ + guard_) throw std::logic_error("Buffer::fill past the end");
  if (bytes == 0) return;
  device_->run_once(
      [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, buffer_, offset, bytes, word); });
}

void Buffer::download(void* data, size_t bytes, size_t offset) const {
  if (offset + bytes > size_ + guard_) throw std::logic_error("Buffer::download past the end");
  if (bytes == 0) return;
  if (mapped_) {
    std::memcpy(data, static_cast<const char*>(mapped_) + offset, bytes);
    return;
  }
  Staging staging(*device_, bytes);
  device_->run_once([&](VkCommandBuffer commands) {
    const VkBufferCopy region{offset, 0, bytes};
    vkCmdCopyBuffer(commands, buffer_, staging.buffer, 1, &region);
  });
  std::memcpy(data, staging.mapped, bytes);
}

DeviceImage::DeviceImage(Device& device, const std::string& name, VkFormat format, uint32_t width,
                         uint32_t height, VkImageUsageFlags usage)
    : device_(&device), format_(format), width_(width), height_(height) {
  const uint32_t limit = device.info().max_image_dimension;
  if (width == 0 || height == 0 || width > limit || height > limit) {
    throw fail(ErrorKind::case_failed, "{}: an image of {} x {} is not within 1 … {}", name, width, height,
               limit);
  }
  const VkImageCreateInfo create{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = format,
                                 .extent = {width, height, 1},
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = usage};
  VK_CHECK(vkCreateImage(device.handle(), &create, nullptr, &image_));
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device.handle(), image_, &needs);
  try {
    memory_ = allocate(device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, name);
  } catch (...) {
    vkDestroyImage(device.handle(), image_, nullptr);
    throw;
  }
  allocated_ = needs.size;
  VK_CHECK(vkBindImageMemory(device.handle(), image_, memory_, 0));
  const VkImageAspectFlags aspect = is_depth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .image = image_,
                                   .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                   .format = format,
                                   .subresourceRange = {aspect, 0, 1, 0, 1}};
  VK_CHECK(vkCreateImageView(device.handle(), &view, nullptr, &view_));
  device.name_object(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image_), name);
}

DeviceImage::~DeviceImage() {
  if (!image_) return;
  vkDestroyImageView(device_->handle(), view_, nullptr);
  vkDestroyImage(device_->handle(), image_, nullptr);
  vkFreeMemory(device_->handle(), memory_, nullptr);
  device_->count_memory(-static_cast<int64_t>(allocated_));
}

void DeviceImage::swap(DeviceImage& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(image_, other.image_);
  std::swap(view_, other.view_);
  std::swap(memory_, other.memory_);
  std::swap(format_, other.format_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  std::swap(allocated_, other.allocated_);
}

void transition(VkCommandBuffer commands, const DeviceImage& image, VkImageLayout from, VkImageLayout to) {
  const VkImageAspectFlags aspect = image.is_depth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  const VkImageMemoryBarrier2 barrier{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      .srcAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
      .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image.handle(),
      .subresourceRange = {aspect, 0, 1, 0, 1}};
  const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .imageMemoryBarrierCount = 1,
                                    .pImageMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &dependency);
}

void DeviceImage::upload(const void* texels, size_t bytes) {
  Staging staging(*device_, bytes);
  std::memcpy(staging.mapped, texels, bytes);
  device_->run_once([&](VkCommandBuffer commands) {
    transition(commands, *this, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {width_, height_, 1}};
    vkCmdCopyBufferToImage(commands, staging.buffer, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &region);
    transition(commands, *this, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void DeviceImage::download(void* texels, size_t bytes) const {
  Staging staging(*device_, bytes);
  device_->run_once([&](VkCommandBuffer commands) {
    transition(commands, *this, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {width_, height_, 1}};
    vkCmdCopyImageToBuffer(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.buffer, 1,
                           &region);
    transition(commands, *this, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
  std::memcpy(texels, staging.mapped, bytes);
}

}  // namespace vsglbench
