// Splats points of the scene into each light's map; every map takes its own random subset (Ritschel 2008 §4).
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Frames { vec4 frames[]; };
layout(set = 0, binding = 1, std430) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 2, std430) buffer Maps { uint maps[]; };
layout(push_constant, scalar) uniform Push { uint count, map_size, per_map, pool; };
#define ISM_WRITE
#include "ism.glsl"

void main() {
  uint i = gl_GlobalInvocationID.x, k = gl_GlobalInvocationID.y;
  if (i >= per_map || k >= count) return;
  // Consecutive slices of the pool, which is in random order already.
  vec3 point = points[(k * per_map + i) % pool].xyz;
  vec4 origin = frames[2u * k];
  vec3 d = point - origin.xyz;
  float distance = length(d);
  uvec2 texel;
  if (distance <= max(origin.w, 1e-4)) return;
  if (!ism_texel(frames[2u * k + 1u].xyz, d / distance, map_size, texel)) return;
  atomicMin(maps[(k * map_size + texel.y) * map_size + texel.x], floatBitsToUint(distance));
}
