// Origin and axis of each light's shadow map.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#if LIGHT_VPL
layout(set = 0, binding = 0, scalar) readonly buffer Lights { Vpl lights[]; };
#else
layout(set = 0, binding = 0, scalar) readonly buffer Lights { Vsgl lights[]; };
#endif
layout(set = 0, binding = 1, std430) writeonly buffer Frames { vec4 frames[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  float tolerance;  // metres
};
// How far from a VSGL's mean nothing counts as an occluder: 1 its standard deviation, 0 no more than
// `tolerance` of it.
#ifndef LIGHT_CLEARANCE
#define LIGHT_CLEARANCE 0
#endif

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= count) return;
#if LIGHT_VPL
  frames[2u * k] = vec4(lights[k].position, 0.1 * tolerance);
  frames[2u * k + 1u] = vec4(lights[k].geometric_normal, 0.0);
#else
  float sigma = sqrt(lights[k].variance);
  frames[2u * k] =
      vec4(lights[k].mean, max(LIGHT_CLEARANCE == 1 ? sigma : min(sigma, tolerance), 0.1 * tolerance));
  frames[2u * k + 1u] = vec4(lights[k].diffuse_axis, 1.0);
#endif
}
