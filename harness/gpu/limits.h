// Limits that kernels and dispatches are cut to.
#pragma once

#include <cstdint>

namespace vsglbench::limits {

// lavapipe ends all loops of an invocation after so many rounds together, without a word: later ones are left
// after their first, and what the kernel writes is cut short (gpu/loop_check.h finds such a kernel).
inline constexpr uint32_t loop_rounds = 65535;

// Items that one invocation may go through where each takes up to four rounds, loops within loops included.
inline constexpr uint32_t quarter_of_rounds = (loop_rounds + 1) / 4;

// Workgroups along one dimension of a dispatch, and bytes of push constants, that every device allows
// [Vulkan 1.3, required limits maxComputeWorkGroupCount and maxPushConstantsSize].
inline constexpr uint32_t groups = 65535;
inline constexpr uint32_t push_bytes = 128;

}  // namespace vsglbench::limits
