// Two levels of the moment pyramid, `level` and the next: powers become means over the covered base texels,
// moments merge. An invocation makes one texel of the upper level and the four below it.
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#define MOMENTS_BINDING 0
#include "moments_buffers.glsl"
#include "pyramid.glsl"
layout(push_constant, scalar) uniform Push { uint width, height, level; };

uvec2 base_size() { return uvec2(width, height); }

// Share of child k in texel `at` of level l; 0 where the image ends before it.
float share(uint l, uvec2 at, uvec2 child) {
  return covered(base_size(), l - 1u, child) / covered(base_size(), l, at);
}
uvec2 child(uvec2 at, uint k) { return 2u * at + uvec2(k & 1u, k >> 1u); }

// Texel `at` of level l, from the four below it, which are in memory.
Moments merged(uint l, uvec2 at) {
  uvec2 below = level_size(base_size(), l - 1u);
  uint from = level_offset(base_size(), l - 1u);
  Moments children[4];
  vec4 factor;
  [[unroll]] for (uint k = 0u; k < 4u; ++k) {
    uvec2 t = child(at, k);
    factor[k] = share(l, at, t);
    t = min(t, below - 1u);
    children[k] = load_moments(from + t.y * below.x + t.x);
  }
  return merge(children, factor);
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  uvec2 size = level_size(base_size(), level), upper = level_size(base_size(), level + 1u);
  if (at.x >= upper.x || at.y >= upper.y) return;
  uint to = level_offset(base_size(), level);
  Moments children[4];
  vec4 factor;
  [[unroll]] for (uint k = 0u; k < 4u; ++k) {
    uvec2 t = child(at, k), near = min(t, size - 1u);
    factor[k] = share(level + 1u, at, t);
    children[k] = merged(level, near);
    if (t == near) store_moments(to + t.y * size.x + t.x, children[k]);
  }
  if (level < top_level(base_size()))
    store_moments(to + size.x * size.y + at.y * upper.x + at.x, merge(children, factor));
}
