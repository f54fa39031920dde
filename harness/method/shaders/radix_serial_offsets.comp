// Serial variant, step 4: counts become the place of each run's first key in its bin. Runs follow one another
// in the keys' order, so the sort is stable.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) buffer Counters { uvec4 counters[]; };  // [group][bin][lane / 4]
layout(set = 0, binding = 1, std430) readonly buffer Starts { uint starts[]; };
layout(push_constant, std430) uniform Push { uint groups, bins; };

void main() {
  uint bin = gl_GlobalInvocationID.x;
  if (bin >= bins) return;
  uint next = starts[bin];
  for (uint group = 0u; group < groups; ++group) {
    for (uint quad = 0u; quad < LANES / 4u; ++quad) {
      uint at = (group * bins + bin) * (LANES / 4u) + quad;
      uvec4 n = counters[at];
      uvec4 place = uvec4(next, next + n.x, next + n.x + n.y, next + n.x + n.y + n.z);
      counters[at] = place;
      next = place.w + n.w;
    }
  }
}
