#version 460
// All texels of a half as one VSGL, by the functions that methods call.
#include "types.h"
layout(local_size_x = 1) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  Moments sum = empty_moments();
  for (uint i = 0u; i < emitter.width * emitter.height; ++i) {
    Texel t;
    if (load_texel(emitter, ivec2(i % emitter.width, i / emitter.width), t))
      sum = merge_two(sum, leaf_moments(t));
  }
  lights[0] = make_vsgl(sum, 1.0, 0.0);
}
