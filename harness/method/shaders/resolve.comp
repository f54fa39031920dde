// "Additional RSM/G-buffer" [MFIS16 App. D]: the leaf moments of every texel.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#define MOMENTS_BINDING AFTER_MAPS
#include "field.glsl"
#include "moments_buffers.glsl"
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  Texel t;
  Moments m = empty_moments();
  if (load_texel(emitter, ivec2(at), t)) m = leaf_moments(t);
  store_moments(at.y * emitter.width + at.x, m);
}
