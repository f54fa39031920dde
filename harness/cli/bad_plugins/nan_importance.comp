// Finite lights whose axis has a length that is not: on the G-buffer, which the eye lights.
#version 460
#include "light_kernel.glsl"

Vsgl make_light(uint i) {
  Draw d;
  Texel t;
  if (!draw(i, d) || !load_texel(emitter, ivec2(d.texel), t)) return no_light();
  Vsgl v = make_vsgl(leaf_moments(t), d.share, 0.0);
  if (emitter.importance != 0u) v.diffuse_axis = vec3(1e30);
  return v;
}
