// The box round all centres, by one workgroup.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Centres { vec4 centres[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Bounds { vec4 bounds[2]; };
layout(push_constant) uniform Push { uint count; };
shared vec3 low[64], high[64];

void main() {
  uint t = gl_LocalInvocationID.x;
  const float infinity = uintBitsToFloat(0x7F800000u);
  vec3 lo = vec3(infinity), hi = vec3(-infinity);
  for (uint i = t; i < count; i += 64u) {
    vec4 c = centres[i];
    if (c.w > 0.0) {
      lo = min(lo, c.xyz);
      hi = max(hi, c.xyz);
    }
  }
  low[t] = lo;
  high[t] = hi;
  for (uint half_size = 32u; half_size > 0u; half_size /= 2u) {
    barrier();
    if (t < half_size) {
      low[t] = min(low[t], low[t + half_size]);
      high[t] = max(high[t], high[t + half_size]);
    }
  }
  if (t == 0u) {
    bounds[0] = vec4(low[0], 0.0);
    bounds[1] = vec4(high[0], 0.0);
  }
}
