// Sound lights: no weight reaches them.
#version 460
#include "light_kernel.glsl"

Vsgl make_light(uint i) {
  Draw d;
  Texel t;
  if (!draw(i, d) || !load_texel(emitter, ivec2(d.texel), t)) return no_light();
  return make_vsgl(leaf_moments(t), d.share, 0.0);
}
