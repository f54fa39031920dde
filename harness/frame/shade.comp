// Indirect radiance of every pixel: the sum over lights, each through its visibility.
// VISIBILITY 0: none; 1: bit matrix; 2: shadow maps. BIAS_REDUCTION 1: where a light's lobes are smooth
// against the disk it is seen as, its exact BRDFs [VSGL14 §3.3].
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
#include "light_shading.glsl"
#include "random.glsl"
#ifndef BIAS_REDUCTION
#define BIAS_REDUCTION 0
#endif
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
vec4 reflected(Shader shader, uint k, uint pixel) {
  Light light = scaled(lights[k], radius2_scale);
#if BIAS_REDUCTION
  if (light.power > 0.0 && texels[k].power > 0.0 && is_cancelled(shader, light, alpha))
    return vec4(shade_cancelled(shader, light, texels[k]), 1.0);
#endif
  float removed = 0.0;
  vec3 sum = shade_light(shader, light, random_hash(uvec2(pixel, k) ^ random), removed);
  return vec4(sum, removed);
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  uint pixel = at.y * emitter.width + at.x;
  Texel t;
  bool surface = load_texel(emitter, ivec2(at), t);
  vec4 sum = vec4(0.0);
  Shader shader = make_shader(t.surface);
  for (uint k = first; k < first + count; ++k) {
    vec4 light = reflected(shader, k, pixel);
    float seen = visible(k, pixel, t.surface.position);
    sum += vec4(seen * light.rgb, (BIAS_REDUCTION == 1 ? 1.0 : seen) * light.a);
  }
  vec4 before = accumulate != 0u ? indirect[pixel] : vec4(0.0);
  indirect[pixel] = surface ? before + weight * sum : vec4(0.0);
}
