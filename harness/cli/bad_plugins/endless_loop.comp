// A ring search that forgets to end where there is no neighbour.
#version 460
#include "light_kernel.glsl"

Vsgl make_light(uint i) {
  Draw d;
  Texel t;
  if (!draw(i, d) || !load_texel(emitter, ivec2(d.texel), t)) return no_light();
  Moments sum = leaf_moments(t);
  for (uint ring = 1u; moments_weight(sum) > 0.0; ++ring) {
    sum = merge_two(sum, empty_moments());
    if (sum.mean.x > 1e30) break;
  }
  return make_vsgl(sum, d.share, 0.0);
}
