// BRSM: the lights made on the G-buffer shade every RSM texel, without visibility, with the texel's BRDF
// towards the primary light. IMPORTANCE_L2 0: p ∝ luminance of (Φ × that), the mean over the view of what the
// texel's light adds to a pixel [VSGL14 §3; Ritschel 2011]. 1: the root of the mean of its square, from the
// sum of c²/power, c being a light's part of that luminance. A VPL's power is its share of the view; a VSGL's
// is that times its reflectance, so that dark pixels count more.
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

// What a light adds to the sum, of a texel whose flux is `tint` in units of its luminance.
float worth(vec3 tint, vec3 radiance, float power) {
  float p = luminance(tint * radiance);
  return IMPORTANCE_L2 == 1 ? p * (p / max(power, 1e-30)) : p;
}

// An invocation takes COLUMN texels, as in shade.comp.
void main() {
  uvec2 corner = gl_WorkGroupID.xy * uvec2(8u, 8u * COLUMN) + gl_LocalInvocationID.xy;
  uint texels[COLUMN];
  bool surface[COLUMN], inside[COLUMN];
  vec3 tint[COLUMN];
  float flux[COLUMN], sums[COLUMN];
  Shader shaders[COLUMN];
  [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
    uvec2 at = corner + uvec2(0u, 8u * j), last = uvec2(emitter.width, emitter.height) - 1u;
    inside[j] = at.x <= last.x && at.y <= last.y;
    at = min(at, last);
    Texel t;
    surface[j] = load_texel(emitter, ivec2(at), t);
    texels[j] = at.y * emitter.width + at.x;
    flux[j] = luminance(t.flux);
    tint[j] = t.flux / max(flux[j], 1e-30);
    shaders[j] = make_shader(t.surface);
    sums[j] = 0.0;
  }
  float removed = 0.0;
  for (uint k = first; k < first + count; ++k) {
    Light light = lights[k];
    [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
      sums[j] += worth(tint[j], shade_light(shaders[j], light, 0u, removed), light.power);
    }
  }
  [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
    if (!inside[j]) continue;
    float p = flux[j] * (IMPORTANCE_L2 == 1 ? sqrt(sums[j]) : sums[j]);
    p = !surface[j] || p <= 0.0 ? 0.0 : p;  // a NaN or Inf stays: it is for the health gate to see
    float before = first > 0u ? pdf[texels[j]] : 0.0, sum = before + p;
    pdf[texels[j]] = IMPORTANCE_L2 == 1 ? sum * length(vec2(before, p) / max(sum, 1e-37)) : sum;
  }
}
