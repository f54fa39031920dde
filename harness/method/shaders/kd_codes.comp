// Morton codes of the centres; that of what is no centre comes after all others.
#version 460
#include "kd_morton.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Centres { vec4 centres[]; };
layout(set = 0, binding = 1, std430) readonly buffer Bounds { vec4 bounds[2]; };
layout(set = 0, binding = 2, std430) writeonly buffer Codes { uint codes[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  vec4 c = centres[i];
  codes[i] = c.w > 0.0 ? morton_code(c.xyz, bounds[0].xyz, bounds[1].xyz) : 1u << CODE_BITS;
}
