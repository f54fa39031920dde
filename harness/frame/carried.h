// What methods carry over from one frame of an animation to the next.
#pragma once

#include <array>
#include <vector>

#include "method/method.h"

namespace vsglbench {

// Of one light set, on both halves.
class CarriedLights {
 public:
  // For the next frame; its buffer is null where there are no `bytes` to carry.
  CarriedState next(Device& device, Half half, size_t bytes);
  // Null before the first frame, and where nothing is carried.
  const Buffer* buffer(Half half) const;

 private:
  struct State {
    Buffer buffer;
    uint32_t frames = 0;
  };
  std::array<State, 2> states_;
};

// Of all frames of one seed, a set for each iteration of a progressive frame; empty before frame 0.
using Carried = std::vector<CarriedLights>;

}  // namespace vsglbench
