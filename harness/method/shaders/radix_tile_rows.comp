// Tile variant, step 2: one workgroup a bin turns the bin's counts into their exclusive prefix sum over
// tiles, and writes the bin's total.
#version 460
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "radix_tile.glsl"
layout(set = 0, binding = 0, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Totals { uint totals[]; };
shared uint subgroup_sums[TILE_THREADS];

void main() {
  uint bin = gl_WorkGroupID.x, carry = 0u;
  // Not gl_LocalInvocationID: elements must follow one another in the order of the subgroup scan.
  uint lane = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
  for (uint from = 0u; from < tiles; from += TILE_THREADS) {
    uint tile = from + lane;
    uint n = tile < tiles ? counts[bin * tiles + tile] : 0u;
    uint before = subgroupExclusiveAdd(n), sum = subgroupAdd(n);
    if (subgroupElect()) subgroup_sums[gl_SubgroupID] = sum;
    barrier();
    uint all = 0u;
    for (uint s = 0u; s < gl_NumSubgroups; ++s) {
      before += s < gl_SubgroupID ? subgroup_sums[s] : 0u;
      all += subgroup_sums[s];
    }
    if (tile < tiles) counts[bin * tiles + tile] = carry + before;
    carry += all;
    barrier();
  }
  if (lane == 0u) totals[bin] = carry;
}
