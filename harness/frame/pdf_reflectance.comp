// Importance without lights: the power that each texel reflects; on the G-buffer, where every texel emits the
// same, reflectance [MFIS16 §5]. 0 where there is no surface.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, std430) writeonly buffer Pdf { float pdf[]; };
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  uint i = at.y * emitter.width + at.x;
  Texel t;
  bool surface = load_texel(emitter, ivec2(at), t);
  vec3 reflected =
      (emitter.importance != 0u ? vec3(1.0) : t.flux) * (t.surface.diffuse + specular_reflectance(t.surface));
  pdf[i] = surface ? luminance(reflected) : 0.0;
}
