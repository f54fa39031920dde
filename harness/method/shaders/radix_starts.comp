// Both variants, step 3: exclusive prefix sum of the bins' totals, in place, by one workgroup.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) buffer Totals { uint totals[]; };
layout(push_constant, std430) uniform Push { uint bins; };
shared uint sums[64];

void main() {
  // 1. Sum of an own part.
  uint lane = gl_LocalInvocationID.x, part = (bins + 63u) / 64u;
  uint first = min(lane * part, bins), last = min(first + part, bins), sum = 0u;
  for (uint i = first; i < last; ++i) sum += totals[i];
  sums[lane] = sum;
  barrier();
  // 2. Sum of the parts before it.
  uint next = 0u;
  for (uint i = 0u; i < lane; ++i) next += sums[i];
  // 3. Prefix sums within it.
  for (uint i = first; i < last; ++i) {
    uint total = totals[i];
    totals[i] = next;
    next += total;
  }
}
