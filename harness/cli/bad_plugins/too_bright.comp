// The share without 1/N: each light stands for as much as all of them should.
#version 460
#include "light_kernel.glsl"

Vsgl make_light(uint i) {
  Draw d;
  Texel t;
  if (!draw(i, d) || !load_texel(emitter, ivec2(d.texel), t)) return no_light();
  return make_vsgl(leaf_moments(t), d.share * float(count), 0.0);
}
