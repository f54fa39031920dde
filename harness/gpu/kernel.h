// A compute pipeline made from one .comp file; its bindings are read from the SPIR-V.
#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/reflection.h"
#include "gpu/shader_compiler.h"

namespace vsglbench {

// What a kernel reads or writes at one binding: a storage buffer, or an image read by texelFetch.
struct Binding {
  Binding(const Buffer& b) : buffer(&b) {}
  Binding(const DeviceImage& i) : image(&i) {}
  const Buffer* buffer = nullptr;
  const DeviceImage* image = nullptr;
};

// Descriptor sets that live until reset().
class DescriptorArena {
 public:
  explicit DescriptorArena(Device& device) : device_(device) {}
  ~DescriptorArena();
  DescriptorArena(const DescriptorArena&) = delete;
  DescriptorArena& operator=(const DescriptorArena&) = delete;
  VkDescriptorSet allocate(VkDescriptorSetLayout layout);
  void reset();  // when no command buffer in flight uses a set

 private:
  void add_pool();
  Device& device_;
  std::vector<VkDescriptorPool> pools_;
  size_t current_ = 0;
};

// Descriptor-set and pipeline layout for set 0 and 128 bytes of push constants.
class BindingLayout {
 public:
  BindingLayout() = default;
  BindingLayout(Device& device, std::vector<VkDescriptorType> types, VkShaderStageFlags stages);
  ~BindingLayout();
  BindingLayout(BindingLayout&& other) noexcept { swap(other); }
  BindingLayout& operator=(BindingLayout&& other) noexcept {
    swap(other);
    return *this;
  }
  VkPipelineLayout pipeline_layout() const { return layout_; }
  // Throws std::logic_error when count or kind of `bindings` don't fit.
  void bind(VkCommandBuffer commands, DescriptorArena& arena, VkPipelineBindPoint point,
            std::span<const Binding> bindings, const std::string& name) const;
  void push_constants(VkCommandBuffer commands, const void* data, size_t bytes) const;

 private:
  void swap(BindingLayout& other) noexcept;
  Device* device_ = nullptr;
  std::vector<VkDescriptorType> types_;
  VkShaderStageFlags stages_ = 0;
  VkDescriptorSetLayout set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

VkShaderModule make_shader_module(Device& device, const std::vector<uint32_t>& spirv);

class Kernel {
 public:
  Kernel() = default;
  Kernel(Device& device, const std::filesystem::path& path, const ShaderDefines& defines,
         const std::vector<std::filesystem::path>& include_dirs);
  ~Kernel();
  Kernel(Kernel&& other) noexcept { swap(other); }
  Kernel& operator=(Kernel&& other) noexcept {
    swap(other);
    return *this;
  }

  const std::string& name() const { return name_; }
  const FloatOutputs& float_outputs() const { return float_outputs_; }
  uint32_t push_bytes() const { return push_bytes_; }  // of its push-constant block
  // Binds and dispatches groups; a group count of zero records nothing. Throws Error(plugin) where
  // `push_bytes` is not the size of the kernel's block: what is missing would be read as garbage, and what is
  // over, left out.
  void dispatch(VkCommandBuffer commands, DescriptorArena& arena, std::span<const Binding> bindings,
                const void* push, size_t push_bytes, uint32_t groups_x, uint32_t groups_y = 1,
                uint32_t groups_z = 1) const;

 private:
  void swap(Kernel& other) noexcept;
  Device* device_ = nullptr;
  std::string name_;
  BindingLayout layout_;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  FloatOutputs float_outputs_;
  uint32_t push_bytes_ = 0;
};

}  // namespace vsglbench
