// One level of a PDF pyramid: means over the covered base texels.
#version 460
#include "types.h"
#include "pyramid.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, std430) buffer Pdf { float pdf[]; };
layout(push_constant, scalar) uniform Push { uint width, height, level; };

void main() {
  uvec2 base = uvec2(width, height), at = gl_GlobalInvocationID.xy;
  uvec2 size = level_size(base, level), below = level_size(base, level - 1u);
  if (at.x >= size.x || at.y >= size.y) return;
  uint from = level_offset(base, level - 1u);
  float sum = 0.0;
  for (uint k = 0u; k < 4u; ++k) {
    uvec2 t = 2u * at + uvec2(k & 1u, k >> 1u);
    if (t.x < below.x && t.y < below.y) sum += covered(base, level - 1u, t) * pdf[from + t.y * below.x + t.x];
  }
  pdf[level_offset(base, level) + at.y * size.x + at.x] = sum / covered(base, level, at);
}
