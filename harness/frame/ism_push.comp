// Push: an empty texel takes the value of its parent.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Coarse { uint coarse[]; };
layout(set = 0, binding = 1, std430) buffer Fine { uint fine[]; };
layout(push_constant, scalar) uniform Push { uint count, size; };  // size: of the fine level
#define ISM_WRITE
#include "ism.glsl"

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count * size * size) return;
  uint x = i % size, y = (i / size) % size, k = i / (size * size);
  if (fine[i] >= kIsmEmpty) fine[i] = coarse[(k * (size / 2u) + y / 2u) * (size / 2u) + x / 2u];
}
