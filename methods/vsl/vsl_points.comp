// The lights of `vpl`, each with the radius of the disk that its share of texels covers, until its neighbours
// say more.
#version 460
#include "light_kernel.glsl"

// parameter[0]: samples under a half angle of π/2.
Vpl make_light(uint i) {
  Draw d;
  Texel t;
  bool drawn = draw(i, d);
  bool surface = load_texel(emitter, ivec2(d.texel), t);
  Vpl light = make_vpl(t, drawn && surface ? d.share : 0.0);
  light.samples = parameter[0];
  light.radius = surface ? sqrt(max(d.share, 1.0) * t.footprint / PI) : 0.0;
  return light;
}
