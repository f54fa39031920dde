// Both variants, step 1: where each cluster's texels start; entry N is where the last cluster's end.
#version 460
#include "types.h"
#include "cluster_sum.glsl"
layout(local_size_x = GROUP) in;
layout(set = 0, binding = 0, std430) readonly buffer Ids { uint ids[]; };  // ascending
layout(set = 0, binding = 1, std430) writeonly buffer Starts { uint starts[]; };
layout(push_constant, std430) uniform Push { uint count, clusters; };
#define ID(i) ids[i]

void main() {
  uint cluster = INVOCATION;
  if (cluster > clusters) return;
  LOWER_BOUND(first, count, cluster, ID)
  starts[cluster] = first;
}
