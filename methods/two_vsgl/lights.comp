// The two sums as lights.
#version 460
#include "types.h"
#include "moments.glsl"
#include "two_vsgl.glsl"
layout(set = 0, binding = 0, scalar) readonly buffer From { Pair from[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i == 0u) lights[0] = make_vsgl(from[0].diffuse, 1.0, -1.0);
  if (i == 1u && count > 1u) lights[1] = make_vsgl(from[0].specular, 1.0, -1.0);
}
