// Segmented sum, last step: each invocation sums what is left of a cluster, at most BLOCK partial sums, and
// makes the light.
#version 460
#include "types.h"
#include "cluster_sum.glsl"
layout(local_size_x = GROUP) in;
layout(set = 0, binding = 0, std430) readonly buffer Starts { uint starts[]; };  // [level][0..N]
layout(set = 0, binding = 1, scalar) readonly buffer Partials { Moments partials[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, std430) uniform Push { uint clusters, level; };

void main() {
  uint cluster = INVOCATION;
  if (cluster >= clusters) return;
  uint at = level * (clusters + 1u) + cluster, first = starts[at], last = starts[at + 1u];
  Sum sum = empty_sum();
  for (uint i = first; i < last; ++i) add(sum, partials[i]);
  if (first == last) {
    lights[cluster] = no_light();
  } else {
    lights[cluster] = make_vsgl(total(sum), 1.0, -1.0);
  }
}
