// On which device of this machine a task measures. Slurm and its like give a task its GPU by
// CUDA_VISIBLE_DEVICES, which Vulkan does not read: the GPU is told by its UUID.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "gpu/device.h"

namespace vsglbench {

// The exit code of a task on another device than the wanted one. It reports nothing.
inline constexpr int kWrongDevice = 6;

struct WrongDevice : Error {
  explicit WrongDevice(const std::string& message) : Error(ErrorKind::device, message) {}
};

struct DeviceWish {
  std::string select;                       // as in select_device(); empty: by what the engine gave
  std::optional<std::string> cuda_visible;  // CUDA_VISIBLE_DEVICES; nothing: not set
  std::string require;  // part of the name that the device must have, or its UUID; empty: any
};
// With CUDA_VISIBLE_DEVICES of the environment.
DeviceWish device_wish(const std::string& select, const std::string& require);

// The UUID, as DeviceInfo has it, of the GPU that CUDA counts so; nothing where no library tells.
using GpuOfIndex = std::function<std::optional<std::string>(unsigned index)>;

// The first GPU that CUDA_VISIBLE_DEVICES names, by index or UUID; where it names none, a device that is no
// GPU. Not set: select_device(). An index that no library knows the UUID of is taken for the only GPU, or for
// a device that is none where there is no GPU, with a warning. Throws WrongDevice, or Error(device) where
// there is no device at all.
const DeviceInfo& choose_device(const std::vector<DeviceInfo>& devices, const DeviceWish& wish,
                                const GpuOfIndex& gpu_of_index);

// Whether --require-device is met.
bool is_required(const std::string& name, const std::string& uuid, const std::string& require);

// choose_device() of this machine's devices, looked at in a process of its own: the caller must be able to
// fork.
DeviceInfo find_device(const DeviceWish& wish);

}  // namespace vsglbench
