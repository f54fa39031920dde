// Every texel a light: the answer without clustering. EXACT 1: VPLs with exact BRDFs; 0: each texel's SG
// lobes.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
#include "vpl_light.glsl"
#if EXACT
layout(set = 0, binding = AFTER_MAPS, scalar) writeonly buffer Lights { Vpl lights[]; };
#else
layout(set = 0, binding = AFTER_MAPS, scalar) writeonly buffer Lights { Vsgl lights[]; };
#endif
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  uint i = at.y * emitter.width + at.x;
  Texel t;
  bool surface = load_texel(emitter, ivec2(at), t);
#if EXACT
  lights[i] = make_vpl(t, surface ? 1.0 : 0.0);
#else
  lights[i] = surface ? make_vsgl(leaf_moments(t), 1.0, 0.0) : no_light();
#endif
}
