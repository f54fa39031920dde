// Virtual point lights: texels drawn by warping the PDF, unfiltered (Keller 1997; [VSGL14] Eq. 1).
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = 5, std430) readonly buffer Pdf { float pdf[]; };
#define PDF(i) pdf[i]
#include "warp.glsl"
layout(set = 0, binding = 6, scalar) writeonly buffer Lights { Vpl lights[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;  // N
  uint step;   // floor(2^32/N)
  uvec2 shift;
};
#include "vpl_light.glsl"

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uvec2 base = uvec2(emitter.width, emitter.height);
  float mean = PDF(level_offset(base, top_level(base)));
  Texel t;
  // An unlit or absent texel, or a PDF that is zero everywhere, gives no light.
  float share = 0.0;
  uvec2 at = uvec2(0u);
  if (mean > 0.0) {
    at = warp(base, unit_interval(lattice_point(i, step, shift)));
    // Flux Φ/(N p) of a texel drawn with density p = M times its probability.
    float p = PDF(at.y * base.x + at.x) / mean;
    share = float(base.x) * float(base.y) / (float(count) * p);
  }
  bool surface = load_texel(emitter, ivec2(at), t);
  lights[i] = make_vpl(t, surface ? share : 0.0);
}
