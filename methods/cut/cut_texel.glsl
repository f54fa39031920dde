// A texel as a point of six coordinates: its position, and its shading normal times what that counts: 1, and
// more by `glossy` times the specular part of the reflectance at normal incidence, since a lobe turns twice
// as far as its normal. False where the emitter sees no surface.
#ifndef VSGLBENCH_CUT_TEXEL_GLSL
#define VSGLBENCH_CUT_TEXEL_GLSL

#include "field_maps.glsl"
#include "field.glsl"

bool load_point(Emitter e, ivec2 texel, float glossy, out vec3 position, out vec3 direction) {
  Texel t;
  bool surface = load_texel(e, texel, t);
  float diffuse = luminance(t.surface.diffuse), specular = luminance(t.surface.f0);
  position = t.surface.position;
  direction = (1.0 + glossy * specular / max(diffuse + specular, 1e-20)) * t.surface.normal;
  return surface;
}

#endif
