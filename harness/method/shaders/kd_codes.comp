// Morton codes of the centres: 15 bits an axis in 2-D, 10 in 3-D, on a cube round all of them.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Centres { vec4 centres[]; };
layout(set = 0, binding = 1, std430) readonly buffer Bounds { vec4 bounds[2]; };
layout(set = 0, binding = 2, std430) writeonly buffer Codes { uint codes[]; };
layout(push_constant) uniform Push { uint count; };

const uint BITS = DIMENSIONS == 2 ? 15u : 10u;
const uint LAST_CODE = 1u << 30;  // of what is no centre: after all others

// Bit i of v goes to bit DIMENSIONS·i.
uint spread(uint v) {
#if DIMENSIONS == 2
  v = (v | v << 8) & 0x00FF00FFu;
  v = (v | v << 4) & 0x0F0F0F0Fu;
  v = (v | v << 2) & 0x33333333u;
  return (v | v << 1) & 0x55555555u;
#else
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
#endif
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uint code = LAST_CODE;
  if (centres[i].w > 0.0) {
    vec3 extent = bounds[1].xyz - bounds[0].xyz;
    float size = max(extent.x, max(extent.y, extent.z));
    vec3 t = size > 0.0 ? (centres[i].xyz - bounds[0].xyz) / size : vec3(0.0);
    uvec3 q = uvec3(clamp(t, 0.0, 1.0) * float((1u << BITS) - 1u));
    code = spread(q.x) | spread(q.y) << 1;
#if DIMENSIONS == 3
    code |= spread(q.z) << 2;
#endif
  }
  codes[i] = code;
}
