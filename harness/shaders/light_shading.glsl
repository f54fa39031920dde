// Lights as shading sees them (light_record.glsl). LIGHT_VSL 1: the Vpl records are virtual spherical lights.
#include "light_record.glsl"
#if LIGHT_VPL
#include "brdf.glsl"
#include "vpl_shading.glsl"
#define Shader Surface
Shader make_shader(Surface s) { return s; }
#elif LIGHT_FILTERED
#include "filtered_shading.glsl"
#define Shader Surface
Shader make_shader(Surface s) { return s; }
#else
#include "vsgl_shading.glsl"
#define Shader Receiver
Shader make_shader(Surface s) { return make_receiver(s); }
#endif

#ifndef LIGHT_VSL
#define LIGHT_VSL 0
#endif
#if LIGHT_VSL
#include "vsl_shading.glsl"
#endif

// Reflected radiance. `random`: a word of this pixel's and light's own, for lights whose integral is sampled.
// `removed`: luminance that a clamp took away is added.
vec3 shade_light(Shader s, Light light, uint random, inout float removed) {
#if LIGHT_VSL
  return shade_vsl(s, light, random);
#elif LIGHT_VPL
  return shade_vpl(s, light, removed);
#elif LIGHT_FILTERED
  return shade_filtered(s, light);
#else
  return shade_vsgl(s, light);
#endif
}
