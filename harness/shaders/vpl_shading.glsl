// One virtual point light at one surface, without visibility [VSGL14 Eq. 1].
#ifndef VSGLBENCH_VPL_SHADING_GLSL
#define VSGLBENCH_VPL_SHADING_GLSL

#include "brdf.glsl"
#include "types.h"

Surface vpl_surface(Vpl light) {
#if LIGHT_LOBES & DIFFUSE_LOBE
  vec3 diffuse = light.diffuse;
#else
  vec3 diffuse = vec3(0.0);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  vec3 f0 = light.f0;
  float ndf = light.ndf;
#else
  vec3 f0 = vec3(0.0);
  float ndf = 1.0;
#endif
  return Surface(light.position, light.normal, light.geometric_normal, light.incident, diffuse, f0, ndf);
}

// ρ(ω) = Φ f(x1) f(x2) cos cos, ω from the surface to the light [VSGL14 §2].
vec3 vpl_rho(Surface s, Vpl light, vec3 direction) {
  return light.flux * brdf_cosine(vpl_surface(light), -direction, LIGHT_LOBES) *
         brdf_cosine(s, direction, SURFACE_LOBES);
}

// ρ/d². Where the light has a clamp, the geometry term cos cos/d² counts as no more than that, and the
// luminance taken away is added to `removed`.
vec3 shade_vpl(Surface s, Vpl light, inout float removed) {
  vec3 to_light = light.position - s.position;
  float distance2 = dot(to_light, to_light);
  if (light.power <= 0.0 || distance2 <= 0.0) return vec3(0.0);
  vec3 direction = to_light * inversesqrt(distance2);
  vec3 reflected = vpl_rho(s, light, direction) / distance2;
  if (light.clamp <= 0.0) return reflected;
  float geometry = max(dot(s.normal, direction), 0.0) * max(dot(light.normal, -direction), 0.0) / distance2;
  float kept = geometry > light.clamp ? light.clamp / geometry : 1.0;
  removed += (1.0 - kept) * luminance(reflected);
  return kept * reflected;
}

#endif
