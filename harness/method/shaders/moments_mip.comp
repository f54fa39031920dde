// One level of the moment pyramid: powers become means over the covered base texels, moments merge.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#define MOMENTS_BINDING 0
#include "moments_buffers.glsl"
#include "pyramid.glsl"
layout(push_constant, scalar) uniform Push { uint width, height, level; };

void main() {
  uvec2 base = uvec2(width, height), at = gl_GlobalInvocationID.xy;
  uvec2 size = level_size(base, level), below = level_size(base, level - 1u);
  if (at.x >= size.x || at.y >= size.y) return;
  uint from = level_offset(base, level - 1u);
  float total = covered(base, level, at);
  Moments children[4];
  vec4 factor;
  for (uint k = 0u; k < 4u; ++k) {
    uvec2 t = 2u * at + uvec2(k & 1u, k >> 1u);
    factor[k] = covered(base, level - 1u, t) / total;
    t = min(t, below - 1u);  // factor 0 outside
    children[k] = load_moments(from + t.y * below.x + t.x);
  }
  store_moments(level_offset(base, level) + at.y * size.x + at.x, merge(children, factor));
}
