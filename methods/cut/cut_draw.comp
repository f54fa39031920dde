// Step 1: samples of the PDF, drawn as fis and mfis draw their centres. One without a surface is marked by a
// direction of zero length.
#version 460
#include "cut.glsl"
#include "shading_normal.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D position_map;  // xyz, w > 0 where there is a surface
layout(set = 0, binding = 1) uniform sampler2D normal_map;
layout(set = 0, binding = 2, std430) readonly buffer Pdf { float pdf[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Samples { float samples[]; };
#define PDF(i) pdf[i]
#include "warp.glsl"
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;  // samples
  uint step;   // floor(2^32/count)
  uvec2 shift;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uvec2 base = uvec2(emitter.width, emitter.height);
  vec3 position = vec3(0.0), direction = vec3(0.0);
  if (PDF(level_offset(base, top_level(base))) > 0.0) {
    ivec2 texel = ivec2(warp(base, unit_interval(lattice_point(i, step, shift))));
    vec4 p = texelFetch(position_map, texel, 0);
    position = p.xyz;
    vec3 normal = shading_normal(emitter, texelFetch(normal_map, texel, 0).xyz, position);
    direction = p.w > 0.0 ? normal : vec3(0.0);
  }
  for (uint k = 0u; k < 3u; ++k) {
    samples[6u * i + k] = position[k];
    samples[6u * i + 3u + k] = direction[k];
  }
}
