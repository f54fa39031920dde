// Push: an empty texel takes the value of its parent.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Coarse { uint coarse[]; };
layout(set = 0, binding = 1, std430) buffer Fine { uint fine[]; };
layout(push_constant, scalar) uniform Push { uint size; };  // size: of the fine level
const uint kIsmEmpty = 0x7F800000u;                         // as in ism.glsl

void main() {
  uint texel = gl_GlobalInvocationID.x, k = gl_GlobalInvocationID.y;  // one row of groups a light
  if (texel >= size * size) return;
  uint x = texel % size, y = texel / size, i = k * size * size + texel;
  if (fine[i] >= kIsmEmpty) fine[i] = coarse[(k * (size / 2u) + y / 2u) * (size / 2u) + x / 2u];
}
