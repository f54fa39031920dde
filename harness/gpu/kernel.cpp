#include "gpu/kernel.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "gpu/check.h"
#include "gpu/limits.h"
#include "gpu/loop_check.h"

namespace vsglbench {

DescriptorArena::~DescriptorArena() {
  for (const VkDescriptorPool pool : pools_) vkDestroyDescriptorPool(device_.handle(), pool, nullptr);
}

void DescriptorArena::add_pool() {
  constexpr uint32_t sets = 512;
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8 * sets},
                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 6 * sets},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, sets}};
  const VkDescriptorPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = sets,
                                          .poolSizeCount = 3,
                                          .pPoolSizes = sizes};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VK_CHECK(vkCreateDescriptorPool(device_.handle(), &create, nullptr, &pool));
  pools_.push_back(pool);
}

VkDescriptorSet DescriptorArena::allocate(VkDescriptorSetLayout layout) {
  for (;; ++current_) {
    const bool fresh = current_ == pools_.size();
    if (fresh) add_pool();
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pools_[current_],
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = vkAllocateDescriptorSets(device_.handle(), &info, &set);
    if (result == VK_SUCCESS) return set;
    // A full pool: go on with the next. One that is fresh must have room.
    if (fresh || (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL)) {
      check_vulkan(result, "vkAllocateDescriptorSets", __FILE__, __LINE__);
    }
  }
}

void DescriptorArena::reset() {
  for (const VkDescriptorPool pool : pools_) VK_CHECK(vkResetDescriptorPool(device_.handle(), pool, 0));
  current_ = 0;
}

namespace {

uint32_t common_push_bytes(const std::string& name,
                           const std::vector<const std::vector<uint32_t>*>& modules) {
  uint32_t bytes = 0;
  for (const auto* module : modules) {
    const uint32_t own = reflect_push_bytes(*module);
    if (bytes > 0 && own > 0 && own != bytes)
      throw fail(ErrorKind::plugin,
                 "{}: its stages have push-constant blocks of {} and {} bytes; use one block", name, bytes,
                 own);
    bytes = std::max(bytes, own);
  }
  return bytes;
}

}  // namespace

BindingLayout::BindingLayout(Device& device, const std::string& name,
                             const std::vector<const std::vector<uint32_t>*>& modules,
                             VkShaderStageFlags stages)
    : device_(&device),
      name_(name),
      types_(reflect_bindings(*modules.front(), name)),
      push_bytes_(common_push_bytes(name, modules)),
      stages_(stages) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (uint32_t i = 0; i < types_.size(); ++i) bindings.push_back({i, types_[i], 1, stages, nullptr});
  const VkDescriptorSetLayoutCreateInfo set{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                            .bindingCount = static_cast<uint32_t>(bindings.size()),
                                            .pBindings = bindings.data()};
  VK_CHECK(vkCreateDescriptorSetLayout(device.handle(), &set, nullptr, &set_));
  const VkPushConstantRange range{stages, 0, limits::push_bytes};
  std::vector<VkDescriptorSetLayout> sets = {set_};
  if (const LoopCheck* check = LoopCheck::of(device); check && stages == VK_SHADER_STAGE_COMPUTE_BIT)
    sets.push_back(check->layout());
  const VkPipelineLayoutCreateInfo layout{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = static_cast<uint32_t>(sets.size()),
                                          .pSetLayouts = sets.data(),
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &range};
  VK_CHECK(vkCreatePipelineLayout(device.handle(), &layout, nullptr, &layout_));
}

BindingLayout::~BindingLayout() {
  if (!device_) return;
  vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_->handle(), set_, nullptr);
}

void BindingLayout::swap(BindingLayout& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(name_, other.name_);
  std::swap(types_, other.types_);
  std::swap(push_bytes_, other.push_bytes_);
  std::swap(stages_, other.stages_);
  std::swap(set_, other.set_);
  std::swap(layout_, other.layout_);
}

void BindingLayout::bind(VkCommandBuffer commands, DescriptorArena& arena, VkPipelineBindPoint point,
                         const Bindings& given) const {
  const std::span<const Binding> bindings = given.all();
  if (bindings.size() != types_.size()) {
    throw std::logic_error(
        fmt::format("{} has {} bindings, {} given", name_, types_.size(), bindings.size()));
  }
  const VkDescriptorSet set = arena.allocate(set_);
  std::vector<VkDescriptorBufferInfo> buffers(bindings.size());
  std::vector<VkDescriptorImageInfo> images(bindings.size());
  std::vector<VkWriteDescriptorSet> writes;
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    const bool is_image = types_[i] == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    if (is_image != (bindings[i].image != nullptr)) {
      throw std::logic_error(
          fmt::format("{}: binding {} takes {}", name_, i, is_image ? "an image" : "a buffer"));
    }
    if (is_image) {
      images[i] = {device_->sampler(), bindings[i].image->view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    } else {
      buffers[i] = {bindings[i].buffer->handle(), 0, VK_WHOLE_SIZE};
    }
    writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                      .dstSet = set,
                      .dstBinding = i,
                      .descriptorCount = 1,
                      .descriptorType = types_[i],
                      .pImageInfo = &images[i],
                      .pBufferInfo = &buffers[i]});
  }
  vkUpdateDescriptorSets(device_->handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
  vkCmdBindDescriptorSets(commands, point, layout_, 0, 1, &set, 0, nullptr);
}

void BindingLayout::check_push(size_t bytes) const {
  if (bytes == push_bytes_) return;
  throw fail(
      ErrorKind::plugin,
      "{}: its push-constant block has {} bytes, and the host pushes {}; make both the same (scalar layout)",
      name_, push_bytes_, bytes);
}

void BindingLayout::push_constants(VkCommandBuffer commands, const void* data, size_t bytes) const {
  check_push(bytes);
  if (bytes > 0) vkCmdPushConstants(commands, layout_, stages_, 0, static_cast<uint32_t>(bytes), data);
}

VkShaderModule make_shader_module(Device& device, const std::vector<uint32_t>& spirv) {
  const VkShaderModuleCreateInfo create{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = spirv.size() * 4,
                                        .pCode = spirv.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  VK_CHECK(vkCreateShaderModule(device.handle(), &create, nullptr, &module));
  return module;
}

Kernel::Kernel(Device& device, const std::filesystem::path& path, const ShaderDefines& defines,
               const std::vector<std::filesystem::path>& include_dirs)
    : device_(&device), name_(path.filename().string()) {
  LoopCheck* check = LoopCheck::of(device);
  ShaderDefines all = defines;
  if (check) all.emplace(loop_check_define, "1");
  const auto spirv = compile_shader(path, all, include_dirs);
  layout_ = BindingLayout(device, name_, {&spirv}, VK_SHADER_STAGE_COMPUTE_BIT);
  float_outputs_ = reflect_float_outputs(spirv);
  const VkShaderModule module = make_shader_module(device, spirv);
  const uint32_t number = check ? check->number_of(name_) : 0;
  const VkSpecializationMapEntry entry{LoopCheck::kConstant, 0, sizeof number};
  const VkSpecializationInfo constants{1, &entry, sizeof number, &number};
  const VkComputePipelineCreateInfo create{
      .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
      .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                .module = module,
                .pName = "main",
                .pSpecializationInfo = check ? &constants : nullptr},
      .layout = layout_.pipeline_layout()};
  VK_CHECK(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &create, nullptr, &pipeline_));
  vkDestroyShaderModule(device.handle(), module, nullptr);
  device.name_object(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline_), name_);
}

Kernel::~Kernel() {
  if (pipeline_) vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
}

void Kernel::swap(Kernel& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(name_, other.name_);
  std::swap(layout_, other.layout_);
  std::swap(pipeline_, other.pipeline_);
  std::swap(float_outputs_, other.float_outputs_);
}

void Kernel::dispatch(VkCommandBuffer commands, DescriptorArena& arena, const Bindings& bindings,
                      const void* push, size_t push_bytes, uint32_t groups_x, uint32_t groups_y,
                      uint32_t groups_z) const {
  layout_.check_push(push_bytes);  // of a dispatch without groups, too
  if (groups_x == 0 || groups_y == 0 || groups_z == 0) return;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  layout_.bind(commands, arena, VK_PIPELINE_BIND_POINT_COMPUTE, bindings);
  if (const LoopCheck* check = LoopCheck::of(*device_)) {
    const VkDescriptorSet set = check->set();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.pipeline_layout(),
                            LoopCheck::kSet, 1, &set, 0, nullptr);
  }
  layout_.push_constants(commands, push, push_bytes);
  vkCmdDispatch(commands, groups_x, groups_y, groups_z);
}

}  // namespace vsglbench
