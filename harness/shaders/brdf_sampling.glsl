// Directions drawn by a surface's BRDF: a mixture of the cosine and of the half vector's D(h) n·h (Walter et
// al. 2007), in the shares of their reflectances.
#ifndef VSGLBENCH_BRDF_SAMPLING_GLSL
#define VSGLBENCH_BRDF_SAMPLING_GLSL

#include "brdf.glsl"

// From components about `axis` to the world, by the frame of Duff et al. 2017.
vec3 from_frame(vec3 axis, vec3 local) {
  float s = axis.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + axis.z), b = axis.x * axis.y * a;
  return local.x * vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x) +
         local.y * vec3(b, s + axis.y * axis.y * a, -axis.y) + local.z * axis;
}

// Probability of the specular lobe. `lobes`: those that the surface has (types.h), a constant.
float specular_share(Surface s, int lobes) {
  if ((lobes & SPECULAR_LOBE) == 0) return 0.0;
  float specular = luminance(fresnel(s.f0, dot(s.normal, s.view))), diffuse = luminance(s.diffuse);
  return specular > 0.0 ? specular / (specular + diffuse) : 0.0;
}

// Density of sample_brdf() per solid angle, 1/sr.
float brdf_pdf(Surface s, vec3 l, int lobes) {
  float share = specular_share(s, lobes), nl = dot(s.normal, l);
  if ((lobes & SPECULAR_LOBE) == 0) return max(nl, 0.0) / PI;
  vec3 h = safe_normalize(l + s.view, s.normal);
  float lh = dot(l, h), nh = dot(s.normal, h);
  float specular = lh > 0.0 && nh > 0.0 ? ndf_value(s.ndf, s.normal, h) * nh / (4.0 * lh) : 0.0;
  return share * specular + (1.0 - share) * max(nl, 0.0) / PI;
}

// `u` uniform in [0,1)², `choose` in [0,1). May lie below the surface, where the BRDF is zero.
vec3 sample_brdf(Surface s, vec2 u, float choose, int lobes) {
  float cosine2;  // of the angle to the normal
  bool specular = choose < specular_share(s, lobes);
  if (!specular) {
    cosine2 = 1.0 - u.x;
  } else if (!is_phong(s.ndf)) {
    cosine2 = (1.0 - u.x) / (1.0 - u.x + s.ndf * s.ndf * u.x);  // tan² = α² u/(1-u)
  } else {
    cosine2 = pow(1.0 - u.x, 2.0 / (2.0 - s.ndf));  // ∫ D n·h ∝ cos^{n+2}
  }
  float sine = sqrt(max(1.0 - cosine2, 0.0)), phi = 2.0 * PI * u.y;
  vec3 m = from_frame(s.normal, vec3(sine * cos(phi), sine * sin(phi), sqrt(cosine2)));
  return specular ? 2.0 * dot(s.view, m) * m - s.view : m;
}

#endif
