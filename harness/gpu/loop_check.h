// On lavapipe, which ends all loops of an invocation after limits::loop_rounds without a word: which kernel
// it did that to.
//
// Once the rounds are used up every later loop of the invocation is left after its first. So each kernel
// compiled for a CPU device ends with a loop of two rounds, and writes its number where it got only one. On a
// GPU there is no such limit, and a kernel that never ends loses the device.
#pragma once

#include <memory>
#include <string>

#include "gpu/buffer.h"

namespace vsglbench {

// The define that makes compile_shader() append LoopCheck::kSource.
inline constexpr const char* loop_check_define = "VSGLBENCH_LOOP_CHECK";

class LoopCheck {
 public:
  static constexpr uint32_t kSet = 1, kBinding = 77, kConstant = 900;
  // Appended to the source of a kernel whose `main` was renamed to vsglbench_main. The bound is 2, which only
  // the device knows: a loop of known length would be unrolled.
  static constexpr const char* kSource =
      "\n#undef main\n"
      "layout(set = 1, binding = 77) writeonly buffer VsglbenchLoops { uint vsglbench_ended; };\n"
      "layout(constant_id = 900) const uint vsglbench_kernel = 0u;\n"
      "void main() {\n"
      "  vsglbench_main();\n"
      "  uint bound = min(gl_NumWorkGroups.x, 1u) + 1u, rounds = 0u;\n"
      "  for (uint i = 0u; i < bound; ++i) ++rounds;\n"
      "  if (rounds < bound) vsglbench_ended = vsglbench_kernel;\n"
      "}\n";

  // The check of this device; null where it is no CPU.
  static LoopCheck* of(const Device& device);
  static void create(Device& device);  // by the device, at its start and end
  static void destroy(const Device& device);

  explicit LoopCheck(Device& device);
  ~LoopCheck();
  LoopCheck(const LoopCheck&) = delete;
  LoopCheck& operator=(const LoopCheck&) = delete;
  VkDescriptorSetLayout layout() const { return layout_; }
  VkDescriptorSet set() const { return set_; }
  uint32_t number_of(const std::string& kernel);  // from 1
  // When the device is idle: throws Error(plugin) naming the kernel whose loops were ended since the last
  // call.
  void report();

 private:
  Device& device_;
  Buffer ended_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::vector<std::string> kernels_;
};

}  // namespace vsglbench
