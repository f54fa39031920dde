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
  float least;  // metres: what is nearer to a light than this is the surface it stands on
};
// How far from a VSGL's mean nothing counts as an occluder: 0 `least`, 1 its standard deviation.
#ifndef LIGHT_CLEARANCE
#define LIGHT_CLEARANCE 0
#endif

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= count) return;
#if LIGHT_VPL
  frames[2u * k] = vec4(lights[k].position, least);
  frames[2u * k + 1u] = vec4(lights[k].geometric_normal, 0.0);
#else
  float clearance = LIGHT_CLEARANCE == 1 ? sqrt(lights[k].variance) : 0.0;
  frames[2u * k] = vec4(lights[k].mean, max(clearance, least));
  frames[2u * k + 1u] = vec4(lights[k].diffuse_axis, 1.0);
#endif
}
