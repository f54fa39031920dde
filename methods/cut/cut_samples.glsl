// Samples in a buffer, six floats each; the including file declares SAMPLES, the buffer's array. A workgroup
// works at NODES nodes, LANES invocations together at one; they sum in an order that is always the same.
#ifndef VSGLBENCH_CUT_SAMPLES_GLSL
#define VSGLBENCH_CUT_SAMPLES_GLSL

#include "cut.glsl"
layout(local_size_x = LANES, local_size_y = NODES) in;

vec3 load_vec3(uint at) { return vec3(SAMPLES[at], SAMPLES[at + 1u], SAMPLES[at + 2u]); }
vec3 sample_position(uint i) { return load_vec3(6u * i); }
vec3 sample_direction(uint i) { return load_vec3(6u * i + 3u); }

#if LANES > 1
#if NODES > 1
#error "invocations that wait for one another must work at one node"
#endif
shared mat4 pool[LANES];
#endif

// Sum of the matrices of a node's invocations.
mat4 reduce(mat4 v) {
#if LANES > 1
  uint lane = gl_LocalInvocationID.x;
  barrier();
  pool[lane] = v;
  for (uint half_size = LANES / 2; half_size > 0u; half_size /= 2u) {
    barrier();
    if (lane < half_size) pool[lane] += pool[lane + half_size];
  }
  barrier();
  v = pool[0];
#endif
  return v;
}

#endif
