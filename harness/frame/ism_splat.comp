// Splats points of the scene into each light's map; every map takes its own random share
// (Ritschel et al. 2008 §4).
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Frames { vec4 frames[]; };
// xyz: bits of the position; w: the normal, octahedral.
layout(set = 0, binding = 1, std430) readonly buffer Points { uvec4 points[]; };
layout(set = 0, binding = 2, std430) buffer Maps { uint maps[]; };
layout(push_constant, scalar) uniform Push { uint count, map_size, per_map, pool; };
#define ISM_WRITE
#include "ism.glsl"

// A surface has no sides here, so that the lower half of the octahedron isn't used.
vec3 octahedral(uint packed) {
  vec2 p = unpackSnorm2x16(packed);
  return normalize(vec3(p, 1.0 - abs(p.x) - abs(p.y)));
}

void main() {
  uint i = gl_GlobalInvocationID.x, k = gl_GlobalInvocationID.y;
  if (i >= per_map || k >= count) return;
  // Consecutive slices of the pool, which is in random order already.
  uvec4 point = points[(k * per_map + i) % pool];
  vec4 origin = frames[2u * k], axis = frames[2u * k + 1u];
  vec3 d = uintBitsToFloat(point.xyz) - origin.xyz;
  float distance = length(d);
  uvec2 texel;
  if (distance <= origin.w) return;
  if (!ism_texel(axis, d / distance, map_size, texel)) return;
  float depth = ism_depth(distance, d / distance, octahedral(point.w), axis, map_size);
  atomicMin(maps[(k * map_size + texel.y) * map_size + texel.x], floatBitsToUint(depth));
}
