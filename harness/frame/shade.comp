// Indirect radiance of every pixel: the sum over lights, each through its visibility.
// VISIBILITY 0: none; 1: bit matrix; 2: imperfect shadow maps.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
#include "light_kind.glsl"
layout(set = 0, binding = 5, scalar) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 6, std430) buffer Indirect { vec4 indirect[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint first, count;   // lights [first, first+count) in this dispatch
  uint words;          // of visibility bits per light
  uint accumulate;     // 1: add to what is there
  uint map_size;       // of a shadow map
};
#if VISIBILITY == 1
layout(set = 0, binding = 7, std430) readonly buffer Bits { uint bits[]; };
float visible(uint k, uint pixel, vec3 position) {
  return float((bits[(k - first) * words + (pixel >> 5)] >> (pixel & 31u)) & 1u);
}
#elif VISIBILITY == 2
layout(set = 0, binding = 7, std430) readonly buffer Maps { uint maps[]; };
layout(set = 0, binding = 8, std430) readonly buffer Frames { vec4 frames[]; };
#include "ism.glsl"
float visible(uint k, uint pixel, vec3 position) {
  return ism_visible(k, frames[2u * k].xyz, frames[2u * k + 1u].xyz, position);
}
#else
float visible(uint k, uint pixel, vec3 position) { return 1.0; }
#endif

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  uint pixel = at.y * emitter.width + at.x;
  Texel t;
  bool surface = load_texel(emitter, ivec2(at), t);
  vec3 sum = accumulate != 0u ? indirect[pixel].rgb : vec3(0.0);
  Shader shader = make_shader(t.surface);
  for (uint k = first; k < first + count; ++k) {
    sum += visible(k, pixel, t.surface.position) * shade_light(shader, lights[k]);
  }
  indirect[pixel] = surface ? vec4(sum, 1.0) : vec4(0.0);
}
