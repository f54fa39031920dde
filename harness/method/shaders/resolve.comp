// "Additional RSM/G-buffer" [MFIS16 App. D]: the leaf moments of every texel, and level 1 of their pyramid
// while four leaves are at hand: to read them again would cost as much as to make them.
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#define MOMENTS_BINDING AFTER_MAPS
#include "field.glsl"
#include "moments_buffers.glsl"
#include "pyramid.glsl"
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  uvec2 base = uvec2(emitter.width, emitter.height), at = gl_GlobalInvocationID.xy;
  uvec2 size = level_size(base, 1u);
  if (at.x >= size.x || at.y >= size.y) return;
  Moments leaves[4];
  vec4 factor;
  [[unroll]] for (uint k = 0u; k < 4u; ++k) {
    uvec2 t = 2u * at + uvec2(k & 1u, k >> 1u), near = min(t, base - 1u);
    factor[k] = covered(base, 0u, t) / covered(base, 1u, at);  // 0 outside
    Texel texel;
    leaves[k] = empty_moments();
    if (load_texel(emitter, ivec2(near), texel)) leaves[k] = leaf_moments(texel);
    if (t == near) store_moments(t.y * base.x + t.x, leaves[k]);
  }
  if (top_level(base) > 0u) store_moments(base.x * base.y + at.y * size.x + at.x, merge(leaves, factor));
}
