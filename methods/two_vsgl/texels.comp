// Texels, kFan at a time, as the two sums.
#version 460
#include "types.h"
#include "field_maps.glsl"
#include "field.glsl"
#include "two_vsgl.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) writeonly buffer Sums { Pair sums[]; };
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  uint i = gl_GlobalInvocationID.x, texels = emitter.width * emitter.height;
  if (i >= (texels + kFan - 1u) / kFan) return;
  Pair sum = Pair(empty_moments(), empty_moments());
  for (uint k = i * kFan; k < min((i + 1u) * kFan, texels); ++k) {
    Texel t;
    if (!load_texel(emitter, ivec2(k % emitter.width, k / emitter.width), t)) continue;
    Moments diffuse = leaf_moments(t), specular = diffuse;
#if LIGHT_LOBES & SPECULAR_LOBE
    diffuse.specular = empty_lobe();
#endif
#if LIGHT_LOBES & DIFFUSE_LOBE
    specular.diffuse = empty_lobe();
#endif
    sum = Pair(merge_two(sum.diffuse, diffuse), merge_two(sum.specular, specular));
  }
  sums[i] = sum;
}
