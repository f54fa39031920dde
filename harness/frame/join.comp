// Joins the shares that shade.comp gave the pixels of every INTERLEAVE × INTERLEAVE block. Any window of so
// many pixels holds each share once, so that where all its pixels lie on one surface their mean is the whole
// sum. A pixel whose surface is another's is left out (Segovia et al. 2006). Shares are joined as what they
// are per reflectance, so that textures keep their detail.
#version 460
#include "types.h"
layout(local_size_x = 8, local_size_y = 8) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, std430) readonly buffer Shared { vec4 shares[]; };
layout(set = 0, binding = AFTER_MAPS + 1, std430) writeonly buffer Indirect { vec4 indirect[]; };
layout(push_constant, scalar) uniform Push { Emitter emitter; };

// What a surface reflects altogether, roughly, and never 0.
vec3 reflectance(Surface s) { return max(s.diffuse + s.f0, vec3(1e-3)); }

// Whether the shares of b stand for those that a lacks: normals within 26°, and b within 11° of a's plane.
bool is_one_surface(Surface a, Surface b) {
  vec3 d = b.position - a.position;
  float height = dot(a.geometric_normal, d);
  return dot(a.normal, b.normal) > 0.9 && height * height <= 0.04 * dot(d, d);
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy, size = uvec2(emitter.width, emitter.height);
  if (at.x >= size.x || at.y >= size.y) return;
  uint pixel = at.y * size.x + at.x;
  Texel own, other;
  bool surface = load_texel(emitter, ivec2(at), own);
  // The window about the pixel, moved into the image.
  uvec2 room = max(size, uvec2(INTERLEAVE)) - INTERLEAVE;
  uvec2 corner = min(max(at, uvec2(INTERLEAVE / 2)) - INTERLEAVE / 2, room);
  vec4 sum = vec4(0.0);
  float joined = 0.0;
  for (uint k = 0u; k < INTERLEAVE * INTERLEAVE; ++k) {
    uvec2 t = corner + uvec2(k % INTERLEAVE, k / INTERLEAVE);
    bool inside = t.x < size.x && t.y < size.y;
    t = min(t, size - 1u);
    inside = load_texel(emitter, ivec2(t), other) && inside;
    if (inside && is_one_surface(own.surface, other.surface)) {
      vec4 share = shares[t.y * size.x + t.x];
      sum += vec4(share.rgb / reflectance(other.surface), share.a);
      joined += 1.0;
    }
  }
  indirect[pixel] = surface ? sum / max(joined, 1.0) * vec4(reflectance(own.surface), 1.0) : vec4(0.0);
}
