// BRSM: the lights made on the G-buffer shade every RSM texel, without visibility, with the texel's BRDF
// towards the primary light; p ∝ luminance of (Φ × that) [VSGL14 §3; Ritschel 2011].
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#ifndef COLUMN
#define COLUMN 4
#endif
#include "field_maps.glsl"
#include "field.glsl"
#include "light_shading.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = AFTER_MAPS + 1, std430) buffer Pdf { float pdf[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint first, count;  // lights [first, first+count) in this dispatch, added to what the ones before gave
};

// An invocation takes COLUMN texels, as in shade.comp.
void main() {
  uvec2 corner = gl_WorkGroupID.xy * uvec2(8u, 8u * COLUMN) + gl_LocalInvocationID.xy;
  uint texels[COLUMN];
  bool surface[COLUMN], inside[COLUMN];
  vec3 flux[COLUMN], sums[COLUMN];
  Shader shaders[COLUMN];
  [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
    uvec2 at = corner + uvec2(0u, 8u * j), last = uvec2(emitter.width, emitter.height) - 1u;
    inside[j] = at.x <= last.x && at.y <= last.y;
    at = min(at, last);
    Texel t;
    surface[j] = load_texel(emitter, ivec2(at), t);
    texels[j] = at.y * emitter.width + at.x;
    flux[j] = t.flux;
    shaders[j] = make_shader(t.surface);
    sums[j] = vec3(0.0);
  }
  float removed = 0.0;
  for (uint k = first; k < first + count; ++k) {
    Light light = lights[k];
    [[unroll]] for (uint j = 0u; j < COLUMN; ++j) sums[j] += shade_light(shaders[j], light, 0u, removed);
  }
  [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
    if (!inside[j]) continue;
    float p = luminance(flux[j] * sums[j]);
    p = !surface[j] || p <= 0.0 ? 0.0 : p;  // a NaN or Inf stays: it is for the health gate to see
    pdf[texels[j]] = first > 0u ? pdf[texels[j]] + p : p;
  }
}
