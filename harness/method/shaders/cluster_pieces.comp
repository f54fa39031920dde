// Segmented sum, step 2, by one workgroup, once a level: every cluster's items are cut into pieces of at most
// BLOCK; a prefix sum tells where each cluster's pieces start. They are the items of the next level.
#version 460
#include "types.h"
#include "cluster_sum.glsl"
layout(local_size_x = 64) in;
// [level][cluster 0..N]: where the cluster's items start; those of `level` are written here.
layout(set = 0, binding = 0, std430) buffer Starts { uint starts[]; };
layout(push_constant, std430) uniform Push { uint clusters, level; };
shared uint sums[64];

uint pieces(uint cluster) {
  uint from = (level - 1u) * (clusters + 1u) + cluster;
  return (starts[from + 1u] - starts[from] + BLOCK - 1u) / BLOCK;
}

void main() {
  uint lane = gl_LocalInvocationID.x, part = (clusters + 63u) / 64u;
  uint first = min(lane * part, clusters), last = min(first + part, clusters);
  // 1. Pieces of an own part of the clusters.
  uint sum = 0u;
  for (uint c = first; c < last; ++c) sum += pieces(c);
  sums[lane] = sum;
  barrier();
  // 2. Those of the parts before it.
  uint next = 0u;
  for (uint i = 0u; i < lane; ++i) next += sums[i];
  // 3. Prefix sums within it.
  for (uint c = first; c < last; ++c) {
    starts[level * (clusters + 1u) + c] = next;
    next += pieces(c);
  }
  if (lane == 63u) starts[level * (clusters + 1u) + clusters] = next;
}
