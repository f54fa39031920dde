// A compute pipeline made from one .comp file; its bindings are read from the SPIR-V.
#pragma once

#include <vulkan/vulkan.h>

#include <concepts>
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

// Several bindings in the order of their numbers, which stand together in one GLSL header: FieldMaps
// (shaders/field_maps.glsl), MomentBuffers (shaders/moments_buffers.glsl).
template <class T>
concept BindingGroup = requires(const T& group) {
  { group.bindings() } -> std::convertible_to<std::span<const Binding>>;
};

// All that a dispatch binds: {field.maps, pdf, lights}. Numbers follow from the order.
class Bindings {
 public:
  struct Part {
    Part(const Binding& one) : bindings{one} {}
    Part(const Buffer& b) : Part(Binding(b)) {}
    Part(const DeviceImage& i) : Part(Binding(i)) {}
    template <BindingGroup T>
    Part(const T& group) {
      const auto all = group.bindings();
      bindings.assign(all.begin(), all.end());
    }
    std::vector<Binding> bindings;
  };
  Bindings(std::initializer_list<Part> parts) {
    for (const Part& part : parts) add(part);
  }
  void add(const Part& part) { all_.insert(all_.end(), part.bindings.begin(), part.bindings.end()); }
  std::span<const Binding> all() const { return all_; }

 private:
  std::vector<Binding> all_;
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

// Descriptor-set and pipeline layout for set 0 and the push constants, as SPIR-V modules declare them.
// `name`: of the shader, for errors.
class BindingLayout {
 public:
  BindingLayout() = default;
  // The first module's bindings count; push-constant blocks must be of one size in all that have one.
  BindingLayout(Device& device, const std::string& name,
                const std::vector<const std::vector<uint32_t>*>& modules, VkShaderStageFlags stages);
  ~BindingLayout();
  BindingLayout(BindingLayout&& other) noexcept { swap(other); }
  BindingLayout& operator=(BindingLayout&& other) noexcept {
    swap(other);
    return *this;
  }
  VkPipelineLayout pipeline_layout() const { return layout_; }
  // Throws std::logic_error when count or kind of `bindings` don't fit.
  void bind(VkCommandBuffer commands, DescriptorArena& arena, VkPipelineBindPoint point,
            const Bindings& bindings) const;
  // Throws Error(plugin) where `bytes` is not the size of the shader's block: what is missing would be read
  // as garbage, and what is over, left out.
  void check_push(size_t bytes) const;
  void push_constants(VkCommandBuffer commands, const void* data, size_t bytes) const;  // checked
  uint32_t push_bytes() const { return push_bytes_; }  // of the push-constant block; 0: none

 private:
  void swap(BindingLayout& other) noexcept;
  Device* device_ = nullptr;
  std::string name_;
  std::vector<VkDescriptorType> types_;
  uint32_t push_bytes_ = 0;
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
  // Binds and dispatches groups; a group count of zero records nothing. Throws as BindingLayout does.
  void dispatch(VkCommandBuffer commands, DescriptorArena& arena, const Bindings& bindings, const void* push,
                size_t push_bytes, uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1) const;

 private:
  void swap(Kernel& other) noexcept;
  Device* device_ = nullptr;
  std::string name_;
  BindingLayout layout_;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  FloatOutputs float_outputs_;
};

}  // namespace vsglbench
