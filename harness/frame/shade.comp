// Indirect radiance of every pixel: the sum over lights, each through its visibility.
// VISIBILITY 0: none; 1: bit matrix; 2: shadow maps. BIAS_REDUCTION 1: where a light's lobes are smooth
// against the disk it is seen as, its exact BRDFs [VSGL14 §3.3]. INTERLEAVE k: the k × k pixels of a block
// share the lights out: the c-th of them takes lights c, c + k², …, each k² times as bright (Keller and
// Heidrich 2001); a workgroup takes pixels of one c. join.comp makes whole sums of them.
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#ifndef COLUMN
#define COLUMN 4  // texels of an invocation
#endif
#include "field_maps.glsl"
#include "field.glsl"
#include "light_shading.glsl"
#include "random.glsl"
#ifndef BIAS_REDUCTION
#define BIAS_REDUCTION 0
#endif
#ifndef INTERLEAVE
#define INTERLEAVE 1
#endif
#define SETS (INTERLEAVE * INTERLEAVE)
layout(set = 0, binding = AFTER_MAPS, scalar) readonly buffer Lights { Light lights[]; };
// rgb: radiance; a: luminance that a clamp removed, or the number of lights that bias reduction cancelled.
layout(set = 0, binding = AFTER_MAPS + 1, std430) buffer Indirect { vec4 indirect[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint first, count;    // lights [first, first+count) in this dispatch
  uint words;           // of visibility bits per light
  uint accumulate;      // 1: add to what is there
  uint map_size;        // of a shadow map
  float map_tolerance;  // of its depths, metres
  uint random;          // a word of this seed
  float radius2_scale;  // of the square of every light's radius [VSGL14 §5]
  float weight;         // of what is added
  float alpha;          // of the bias reduction
};
#if VISIBILITY == 1
layout(set = 0, binding = AFTER_MAPS + 2 + BIAS_REDUCTION, std430) readonly buffer Bits { uint bits[]; };
float visible(uint k, uint pixel, vec3 position) {
  return float((bits[(k - first) * words + (pixel >> 5)] >> (pixel & 31u)) & 1u);
}
#elif VISIBILITY == 2
layout(set = 0, binding = AFTER_MAPS + 2 + BIAS_REDUCTION, std430) readonly buffer Maps { uint maps[]; };
layout(set = 0, binding = AFTER_MAPS + 3 + BIAS_REDUCTION, std430) readonly buffer Frames { vec4 frames[]; };
#include "ism.glsl"
float visible(uint k, uint pixel, vec3 position) {
  return ism_visible(k, frames[2u * k].xyz, frames[2u * k + 1u].xyz, position);
}
#else
float visible(uint k, uint pixel, vec3 position) { return 1.0; }
#endif
#if BIAS_REDUCTION
layout(set = 0, binding = AFTER_MAPS + 2, scalar) readonly buffer Texels { Vpl texels[]; };
#endif

// rgb and a as `Indirect` has them.
vec4 reflected(Shader shader, Light light, uint k, uint pixel) {
#if BIAS_REDUCTION
  if (light.power > 0.0 && texels[k].power > 0.0 && is_cancelled(shader, light, alpha))
    return vec4(shade_cancelled(shader, light, texels[k]), 1.0);
#endif
  float removed = 0.0;
  vec3 sum = shade_light(shader, light, random_hash(uvec2(pixel, k) ^ random), removed);
  return vec4(sum, removed);
}

// An invocation takes COLUMN pixels, one below the other, so that a light that is loaded serves them
// all.
void main() {
  uvec2 corner = gl_WorkGroupID.xy * uvec2(8u, 8u * COLUMN) + gl_LocalInvocationID.xy;
  uint set = gl_WorkGroupID.z;
  uint pixels[COLUMN];
  bool surface[COLUMN], inside[COLUMN];
  vec3 positions[COLUMN];
  Shader shaders[COLUMN];
  vec4 sums[COLUMN];
  [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
    uvec2 at = (corner + uvec2(0u, 8u * j)) * INTERLEAVE + uvec2(set % INTERLEAVE, set / INTERLEAVE),
          last = uvec2(emitter.width, emitter.height) - 1u;
    inside[j] = at.x <= last.x && at.y <= last.y;
    at = min(at, last);
    Texel t;
    surface[j] = load_texel(emitter, ivec2(at), t);
    pixels[j] = at.y * emitter.width + at.x;
    positions[j] = t.surface.position;
    shaders[j] = make_shader(t.surface);
    sums[j] = vec4(0.0);
  }
  uint own = first + (set + SETS - first % SETS) % SETS;
  for (uint k = own; k < first + count; k += SETS) {
    Light light = scaled(lights[k], radius2_scale);
    [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
      vec4 sum = reflected(shaders[j], light, k, pixels[j]);
      float seen = visible(k, pixels[j], positions[j]);
      sums[j] += vec4(seen * sum.rgb, (BIAS_REDUCTION == 1 ? 1.0 : seen) * sum.a);
    }
  }
  [[unroll]] for (uint j = 0u; j < COLUMN; ++j) {
    if (!inside[j]) continue;
    vec4 before = accumulate != 0u ? indirect[pixels[j]] : vec4(0.0);
    indirect[pixels[j]] = surface[j] ? before + float(SETS) * weight * sums[j] : vec4(0.0);
  }
}
