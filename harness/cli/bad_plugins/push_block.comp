// Its push-constant block has fields that the host does not push, or lacks one that it does.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "moments.glsl"
layout(set = 0, binding = 0, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
#if LARGER
  float scale;
  float bias;
#endif
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) lights[i] = no_light();
}
