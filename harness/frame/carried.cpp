#include "frame/carried.h"

namespace vsglbench {

CarriedState CarriedLights::next(Device& device, Half half, size_t bytes) {
  if (bytes == 0) return {};
  State& state = states_[static_cast<size_t>(half)];
  if (!state.buffer) {
    state.buffer =
        Buffer(device, fmt::format("carried.{}", half_name(half)), bytes, GrowingBuffer::kGuardBytes);
    state.buffer.fill(0, (bytes + 3) / 4 * 4, 0);
  }
  return {&state.buffer, state.frames++};
}

const Buffer* CarriedLights::buffer(Half half) const {
  const Buffer& buffer = states_[static_cast<size_t>(half)].buffer;
  return buffer ? &buffer : nullptr;
}

}  // namespace vsglbench
