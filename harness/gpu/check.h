// Vulkan result codes as errors that report call text, file and line.
#pragma once

#include <vulkan/vulkan.h>

namespace vsglbench {

// VK_SUCCESS returns; anything else throws Error(device_lost).
void check_vulkan(VkResult result, const char* call, const char* file, int line);

}  // namespace vsglbench

#define VK_CHECK(call) ::vsglbench::check_vulkan((call), #call, __FILE__, __LINE__)
