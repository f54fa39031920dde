// What the serial variant's kernels share. LANES invocations a workgroup, a multiple of 4; each owns one run
// of keys and 2^bits counters. Counters lie [group][bin][lane], so that a workgroup's own are contiguous and
// two cores never write to one cache line.
layout(local_size_x = LANES) in;
layout(push_constant, std430) uniform Push {
  uint count;   // keys
  uint length;  // keys a run, a multiple of 4
  uint shift;   // the digit is (key >> shift) & (bins - 1)
  uint bins;
};

uvec4 digit(uvec4 key) { return (key >> shift) & (bins - 1u); }

uvec4 counter_index(uvec4 bin) { return (gl_WorkGroupID.x * bins + bin) * LANES + gl_LocalInvocationID.x; }

// First key of this invocation's run, and one past its last.
uvec2 key_run() {
  uint first = gl_GlobalInvocationID.x * length;
  return min(uvec2(first, first + length), uvec2(count));
}
