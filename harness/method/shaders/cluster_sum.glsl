// Sums of moments over ranges, in an order that depends on the range alone.
//
// Unlike [MFIS16 App. D], which adds up one value after the other: single precision would lose half its
// digits over a million texels, so at most BLOCK sets go into one sum before it is merged into the next
// higher one.
#ifndef VSGLBENCH_CLUSTER_SUM_GLSL
#define VSGLBENCH_CLUSTER_SUM_GLSL

#include "moments.glsl"

#define BLOCK 64u  // as in cluster_sum.cpp
#define GROUP 32   // invocations a workgroup, as in cluster_sum.cpp
// Number of this invocation in a dispatch of one or two dimensions of workgroups.
#define INVOCATION \
  ((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x)

// A running sum; positions are kept as offsets from its first set of any weight, so that far from the origin
// nothing rounds away.
struct Sum {
  Moments moments;
  vec3 base;
};

Sum empty_sum() { return Sum(empty_moments(), vec3(0.0)); }

void add(inout Sum sum, Moments m) {
  if (!(moments_weight(sum.moments) > 0.0)) sum.base = m.mean;
  m.mean -= sum.base;
  sum.moments = merge_two(sum.moments, m);
}

Moments total(Sum sum) {
  Moments m = sum.moments;
  m.mean += sum.base;
  return m;
}

// First index in ascending a[0, n) whose value is not below `key`; a[i] is ASCENDING(i).
#define LOWER_BOUND(result, n, key, ASCENDING)  \
  uint result = 0u;                             \
  for (uint end = n; result < end;) {           \
    uint middle = result + (end - result) / 2u; \
    if (ASCENDING(middle) < (key)) {            \
      result = middle + 1u;                     \
    } else {                                    \
      end = middle;                             \
    }                                           \
  }

#endif
