// The sample lattice on the host, to the bit as shaders/warp.glsl has it: its one spelling in C++.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "method/light_kernel.h"

namespace vsglbench {

// Point i of N in 32-bit fixed point: (i/N, frac(i/φ)) + shift, modulo 1.
inline glm::uvec2 lattice_point(uint32_t i, uint32_t count, glm::uvec2 shift) {
  return glm::uvec2(i * lattice_step(count), i * 0x9E3779B9u) + shift;
}

// In (0,1): the middle of the one of 2^23 intervals that the fixed-point number lies in.
inline glm::dvec2 unit_interval(glm::uvec2 fixed) { return (glm::dvec2(fixed >> 9u) + 0.5) * 0x1p-23; }

}  // namespace vsglbench
