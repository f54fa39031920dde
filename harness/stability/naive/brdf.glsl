// Tests only, a planted fault: the normal distribution from n·h, whose 1-(n·h)² cancels, in place of that of
// shaders/brdf.glsl, which lies beside it as sound_brdf.glsl.
#ifndef NAIVE_BRDF_GLSL
#define NAIVE_BRDF_GLSL

#define ndf_value sound_ndf_value
#define brdf_cosine sound_brdf_cosine
#include "sound_brdf.glsl"
#undef ndf_value
#undef brdf_cosine

float ndf_value(float ndf, vec3 n, vec3 h) {
  float nh = dot(n, h);
  if (ndf < 0.0) return (2.0 - ndf) / (2.0 * PI) * pow(nh, -ndf);
  float d = (nh * nh) * (ndf * ndf - 1.0) + 1.0;
  return ndf * ndf / (PI * d * d);
}

vec3 brdf_cosine(Surface s, vec3 l, int lobes) {
  float nl = dot(s.normal, l);
  float nv = dot(s.normal, s.view);
  if (nl <= 0.0 || nv <= 0.0 || dot(s.geometric_normal, l) <= 0.0) return vec3(0.0);
  vec3 h = safe_normalize(l + s.view, s.normal);
  float specular = ndf_value(s.ndf, s.normal, h) * smith_visibility(nl, nv, masking_alpha(s.ndf));
  return (s.diffuse / PI + specular * fresnel(s.f0, dot(l, h))) * nl;
}

#endif
