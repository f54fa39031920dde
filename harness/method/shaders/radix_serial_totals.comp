// Serial variant, step 2: the number of keys in each bin.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Counters { uvec4 counters[]; };  // [group][bin][quad]
layout(set = 0, binding = 1, std430) writeonly buffer Totals { uint totals[]; };
layout(push_constant, std430) uniform Push { uint groups, bins; };

void main() {
  uint bin = gl_GlobalInvocationID.x;
  if (bin >= bins) return;
  uvec4 sum = uvec4(0u);
  for (uint group = 0u; group < groups; ++group) {
    uint first = (group * bins + bin) * (LANES / 4u);
    for (uint quad = 0u; quad < LANES / 4u; ++quad) sum += counters[first + quad];
  }
  totals[bin] = sum.x + sum.y + sum.z + sum.w;
}
