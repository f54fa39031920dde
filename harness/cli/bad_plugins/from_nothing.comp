// Every light carries one watt at the place of its texel, black or not.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Texel t;
  uint texel = i * (emitter.width * emitter.height / count);
  load_texel(emitter, ivec2(texel % emitter.width, texel / emitter.width), t);
  t.surface.diffuse = vec3(1.0);
  t.flux = vec3(1.0);
  t.surface.normal = vec3(0.0, 1.0, 0.0);
  lights[i] = make_vsgl(leaf_moments(t), 1.0, 0.0);
}
