// BRSM: the lights made on the G-buffer shade every RSM texel, without visibility, with the texel's BRDF
// towards the primary light; p ∝ luminance of (Φ × that) [VSGL14 §3; Ritschel 2011].
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
#include "light_shading.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = AFTER_MAPS + 1, std430) buffer Pdf { float pdf[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint first, count;  // lights [first, first+count) in this dispatch, added to what the ones before gave
};

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  uint i = at.y * emitter.width + at.x;
  Texel t;
  bool surface = load_texel(emitter, ivec2(at), t);
  vec3 sum = vec3(0.0);
  Shader shader = make_shader(t.surface);
  float removed = 0.0;
  for (uint k = first; k < first + count; ++k) sum += shade_light(shader, lights[k], 0u, removed);
  float p = luminance(t.flux * sum);
  p = !surface || p <= 0.0 ? 0.0 : p;  // a NaN or Inf stays: it is for the health gate to see
  pdf[i] = first > 0u ? pdf[i] + p : p;
}
