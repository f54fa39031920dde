// Direct light, for its own image only: exact BRDF, the RSM's positions as a shadow map.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS) uniform sampler2D rsm_position_map;
layout(set = 0, binding = AFTER_MAPS + 1, std430) writeonly buffer Direct { vec4 direct[]; };
layout(set = 0, binding = AFTER_MAPS + 2, scalar) uniform Lamp { Emitter lamp; };
layout(push_constant, scalar) uniform Push { Emitter emitter; };

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  uint pixel = at.y * emitter.width + at.x;
  direct[pixel] = vec4(0.0);
  Texel t;
  if (!load_texel(emitter, ivec2(at), t)) return;
  vec3 d = t.surface.position - lamp.position;
  float z = dot(d, lamp.forward);
  float along = lamp.perspective != 0u ? z : 1.0;
  vec2 plane = vec2(dot(d, lamp.right), dot(d, lamp.up)) / (along * lamp.extent);
  if ((lamp.perspective != 0u && z <= 0.0) || any(greaterThan(abs(plane), vec2(1.0)))) return;
  ivec2 seen = clamp(ivec2((vec2(0.5) + vec2(0.5, -0.5) * plane) * vec2(lamp.width, lamp.height)), ivec2(0),
                     ivec2(lamp.width - 1u, lamp.height - 1u));
  vec4 lit = texelFetch(rsm_position_map, seen, 0);
  vec3 to_light = lamp.perspective != 0u ? -d * inversesqrt(dot(d, d)) : -lamp.forward;
  float irradiance_scale = lamp.perspective != 0u ? 1.0 / dot(d, d) : 1.0;
  // Within 1 % and two texels of what the light sees there.
  float depth = dot(lit.xyz - lamp.position, lamp.forward);
  float texel = 2.0 * along * max(lamp.extent.x / float(lamp.width), lamp.extent.y / float(lamp.height));
  if (lit.w > 0.0 && z > depth * 1.01 + 2.0 * texel) return;
  direct[pixel] = vec4(lamp.power * irradiance_scale * brdf_cosine(t.surface, to_light, SURFACE_LOBES), 1.0);
}
