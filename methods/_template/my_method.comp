// my-method: one VSGL from each texel that the PDF draws, blurred to the size of its share.
#version 460
#include "light_kernel.glsl"

Vsgl make_light(uint i) {
  // 1. A texel, drawn with probability proportional to the PDF.
  Draw d;
  Texel t;
  if (!draw(i, d) || !load_texel(emitter, ivec2(d.texel), t)) return no_light();
  // 2. Its lobes. The light stands for `share` texels, so it is as wide as they are: a square of area a has
  //    variance a/6.
  Moments m = leaf_moments(t);
  m.variance += parameter[0] * d.share * t.footprint / 6.0;
  // 3. Their flux.
  return make_vsgl(m, d.share, 0.0);
}
