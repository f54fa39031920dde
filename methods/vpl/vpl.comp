// Virtual point lights: texels drawn by warping the PDF, unfiltered (Keller 1997; [VSGL14] Eq. 1).
#version 460
#include "light_kernel.glsl"

// Flux Φ/(N p) of a texel drawn with density p. An unlit or absent texel, or a PDF that is zero everywhere,
// gives no light. parameter[0]: clamp of the geometry term, 1/m²; 0: none.
Vpl make_light(uint i) {
  Draw d;
  Texel t;
  bool drawn = draw(i, d);
  bool surface = load_texel(emitter, ivec2(d.texel), t);
  Vpl v = make_vpl(t, drawn && surface ? d.share : 0.0);
  v.clamp = parameter[0];
  return v;
}
