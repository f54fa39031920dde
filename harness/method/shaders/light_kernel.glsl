// One invocation a light (method/light_kernel.h). The including kernel defines
//   LIGHT make_light(uint i)   the i-th of `count` lights; LIGHT is the record of its kind
// and reads: emitter, count, parameter[0..3]; draw(), load_texel(), leaf_moments(), merge(), make_vsgl(),
// no_light(), make_vpl().
#include "types.h"
layout(local_size_x = 64) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, std430) readonly buffer Pdf { float pdf[]; };
#define PDF(i) pdf[i]
#include "warp.glsl"
layout(set = 0, binding = AFTER_MAPS + 1, scalar) writeonly buffer Lights { LIGHT lights[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;  // N
  uint step;   // floor(2^32/N)
  uvec2 shift;
  float parameter[4];
};
#include "vpl_light.glsl"

struct Draw {
  uvec2 texel;
  float p;      // PDF at the texel, of mean 1 over the half
  float share;  // 1/(N × the texel's probability): how many texels' worth of flux the light stands for
};

// Stratified sample i of N: lattice point, warped by the PDF. False where the PDF is zero everywhere.
bool draw(uint i, out Draw d) {
  uvec2 base = uvec2(emitter.width, emitter.height);
  float mean = PDF(level_offset(base, top_level(base)));
  d = Draw(uvec2(0u), 0.0, 0.0);
  if (!(mean > 0.0)) return false;
  d.texel = warp(base, unit_interval(lattice_point(i, step, shift)));
  d.p = PDF(d.texel.y * base.x + d.texel.x) / mean;
  d.share = float(base.x) * float(base.y) / (float(count) * d.p);
  return true;
}

LIGHT make_light(uint i);

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) lights[i] = make_light(i);
}
