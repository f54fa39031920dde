// Origin and axis of each light's shadow map.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "light_record.glsl"
layout(set = 0, binding = 0, scalar) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Frames { vec4 frames[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  float tolerance;  // metres
};
// How far from a cluster's mean nothing counts as an occluder: 1 its standard deviation, 0 no more than
// `tolerance` of it.
#ifndef LIGHT_CLEARANCE
#define LIGHT_CLEARANCE 0
#endif

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= count) return;
  float sigma = light_sigma(lights[k]);
  float clear = max(LIGHT_CLEARANCE == 1 ? sigma : min(sigma, tolerance), 0.1 * tolerance);
  frames[2u * k] = vec4(light_position(lights[k]), clear);
  frames[2u * k + 1u] = light_axis(lights[k]);
}
