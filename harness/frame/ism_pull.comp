// Pull: a coarse texel is the mean of its valid children (Ritschel et al. 2008 §4, after Marroquim 2007).
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Fine { uint fine[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Coarse { uint coarse[]; };
layout(push_constant, scalar) uniform Push { uint size; };  // size: of the coarse level
const uint kIsmEmpty = 0x7F800000u;                         // as in ism.glsl

void main() {
  uint texel = gl_GlobalInvocationID.x, k = gl_GlobalInvocationID.y;  // one row of groups a light
  if (texel >= size * size) return;
  uint x = texel % size, y = texel / size, i = k * size * size + texel;
  float sum = 0.0, n = 0.0, nearest = 3e38;
  for (uint c = 0u; c < 4u; ++c) {
    uint bits = fine[(k * 2u * size + 2u * y + (c >> 1u)) * 2u * size + 2u * x + (c & 1u)];
    if (bits < kIsmEmpty) nearest = min(nearest, uintBitsToFloat(bits));
  }
  // Only children at about the nearest depth are averaged: others lie behind.
  for (uint c = 0u; c < 4u; ++c) {
    uint bits = fine[(k * 2u * size + 2u * y + (c >> 1u)) * 2u * size + 2u * x + (c & 1u)];
    if (bits < kIsmEmpty && uintBitsToFloat(bits) <= 1.1 * nearest) {
      sum += uintBitsToFloat(bits);
      n += 1.0;
    }
  }
  coarse[i] = n > 0.0 ? floatBitsToUint(sum / n) : kIsmEmpty;
}
