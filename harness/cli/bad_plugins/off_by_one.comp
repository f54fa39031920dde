// Light i goes to place i + 1: the first place stays as it was, and the last light lies past the end.
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
  bool surface = load_texel(emitter, ivec2(texel % emitter.width, texel / emitter.width), t);
  float share = float(emitter.width * emitter.height) / float(count);
  lights[i + 1u] = surface ? make_vsgl(leaf_moments(t), share, 0.0) : no_light();
}
