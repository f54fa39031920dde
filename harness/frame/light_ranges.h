// Lights in as many dispatches as the limits of devices ask for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "gpu/limits.h"

namespace vsglbench {

inline constexpr uint32_t most_lights_of_a_dispatch = limits::quarter_of_rounds;

struct LightRange {
  uint32_t first, count;
};

inline std::vector<LightRange> light_ranges(uint32_t count, uint32_t most) {
  std::vector<LightRange> ranges;
  for (uint32_t first = 0; first < count; first += most)
    ranges.push_back({first, std::min(most, count - first)});
  return ranges;
}

}  // namespace vsglbench
