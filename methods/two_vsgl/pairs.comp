// Sums, kFan at a time.
#version 460
#include "types.h"
#include "moments.glsl"
#include "two_vsgl.glsl"
layout(set = 0, binding = 0, scalar) readonly buffer From { Pair from[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer To { Pair to[]; };
layout(push_constant, scalar) uniform Push { uint count; };  // of `from`

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= (count + kFan - 1u) / kFan) return;
  Pair sum = from[i * kFan];
  for (uint k = i * kFan + 1u; k < min((i + 1u) * kFan, count); ++k) {
    sum = Pair(merge_two(sum.diffuse, from[k].diffuse), merge_two(sum.specular, from[k].specular));
  }
  to[i] = sum;
}
