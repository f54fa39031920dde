// Tests only, with moments.glsl: sums about the origin instead of about a set's first position, in place of
// those of method/shaders/cluster_sum.glsl, which lies beside it as sound_cluster_sum.glsl.
#ifndef NAIVE_CLUSTER_SUM_GLSL
#define NAIVE_CLUSTER_SUM_GLSL

#include "moments.glsl"
#define add sound_add
#define total sound_total
#include "sound_cluster_sum.glsl"
#undef add
#undef total

void add(inout Sum sum, Moments m) { sum.moments = merge_two(sum.moments, m); }
Moments total(Sum sum) { return sum.moments; }

#endif
