#include "gpu/loop_check.h"

#include <map>

#include "base/error.h"
#include "gpu/check.h"
#include "gpu/limits.h"

namespace vsglbench {
namespace {

std::map<const Device*, std::unique_ptr<LoopCheck>>& checks() {
  static std::map<const Device*, std::unique_ptr<LoopCheck>> all;
  return all;
}

}  // namespace

LoopCheck* LoopCheck::of(const Device& device) {
  const auto found = checks().find(&device);
  return found == checks().end() ? nullptr : found->second.get();
}
void LoopCheck::create(Device& device) {
  if (device.is_cpu()) checks()[&device] = std::make_unique<LoopCheck>(device);
}
void LoopCheck::destroy(const Device& device) { checks().erase(&device); }

LoopCheck::LoopCheck(Device& device) : device_(device), ended_(device, "loops", 16) {
  const uint32_t none = 0;
  ended_.upload(&none, sizeof none);
  const VkDescriptorSetLayoutBinding binding{kBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                                             VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  const VkDescriptorSetLayoutCreateInfo layout{
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 1, .pBindings = &binding};
  VK_CHECK(vkCreateDescriptorSetLayout(device.handle(), &layout, nullptr, &layout_));
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
  const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = 1,
                                        .poolSizeCount = 1,
                                        .pPoolSizes = &size};
  VK_CHECK(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &pool_));
  const VkDescriptorSetAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = pool_,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &layout_};
  VK_CHECK(vkAllocateDescriptorSets(device.handle(), &allocate, &set_));
  const VkDescriptorBufferInfo buffer{ended_.handle(), 0, VK_WHOLE_SIZE};
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set_,
                                   .dstBinding = kBinding,
                                   .descriptorCount = 1,
                                   .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                   .pBufferInfo = &buffer};
  vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

LoopCheck::~LoopCheck() {
  vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
  vkDestroyDescriptorSetLayout(device_.handle(), layout_, nullptr);
}

uint32_t LoopCheck::number_of(const std::string& kernel) {
  kernels_.push_back(kernel);
  return static_cast<uint32_t>(kernels_.size());
}

void LoopCheck::report() {
  uint32_t ended = 0;
  ended_.download(&ended, sizeof ended);
  if (ended == 0) return;
  const uint32_t none = 0;
  ended_.upload(&none, sizeof none);
  throw fail(ErrorKind::plugin,
             "{}: a loop does not end: lavapipe ends the loops of an invocation after {} rounds, and what it "
             "wrote is cut short; end it, or share its rounds among dispatches",
             kernels_.at(ended - 1), limits::loop_rounds);
}

}  // namespace vsglbench
