// Lambert + one microfacet lobe (D V F), and its spherical-Gaussian approximations.
// Sources: Walter et al. 2007, Heitz 2014 (height-correlated Smith), [VSGL15s] App. A, [MFIS16] App. A.1.
#ifndef VSGLBENCH_BRDF_GLSL
#define VSGLBENCH_BRDF_GLSL

#include "math.glsl"
#include "types.h"

// A surface seen from `view` (unit, away from the surface), as the deferred targets hold it.
struct Surface {
  vec3 position;
  vec3 normal;            // shading
  vec3 geometric_normal;  // on the viewer's side
  vec3 view;
  vec3 diffuse;  // Rd
  vec3 f0;
  float ndf;  // > 0: GGX alpha; < 0: minus the Phong exponent
};

bool is_phong(float ndf) { return PHONG_LOBES == 1 && ndf <= 0.0; }

// Sharpness of the normal distribution as an SG: GGX 2/α², Phong n [VSGL15s App. A].
float ndf_sharpness(float ndf) { return is_phong(ndf) ? -ndf : 2.0 / (ndf * ndf); }
// Its peak: GGX 1/(πα²), Phong (n+2)/(2π).
float ndf_peak(float ndf) { return is_phong(ndf) ? (2.0 - ndf) / (2.0 * PI) : 1.0 / (PI * ndf * ndf); }
// α of the masking term: GGX's own; Phong by Walter et al.'s √(2/(n+2)).
float masking_alpha(float ndf) { return is_phong(ndf) ? sqrt(2.0 / (2.0 - ndf)) : ndf; }

// Schlick; f90 = min(1, 50 max(f0)), so that f0 = 0 means no specular reflection at all.
vec3 fresnel(vec3 f0, float cosine) {
  float f90 = min(1.0, 50.0 * max(f0.r, max(f0.g, f0.b)));
  float m = 1.0 - clamp(cosine, 0.0, 1.0);
  float m2 = m * m;
  return f0 + (vec3(f90) - f0) * (m2 * m2 * m);
}

// Height-correlated Smith G2/(4 n·l n·v) for GGX.
float smith_visibility(float nl, float nv, float alpha) {
  float a2 = alpha * alpha;
  float d = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
  return d > 0.0 ? 0.5 / d : 0.0;
}

// D(h), with 1-(n·h)² taken from the cross product: near the mirror direction n·h has no digits left.
float ndf_value(float ndf, vec3 n, vec3 h) {
  vec3 x = cross(n, h);
  float sin2 = min(dot(x, x), 1.0);
  if (!is_phong(ndf)) {
    float a2 = ndf * ndf;
    float d = sin2 + a2 * (1.0 - sin2);
    return a2 / (PI * d * d);
  }
  // log(1-x) for the exponent e·½·log(1-sin²); by series where 1-sin² would round.
  float log_cos2 = sin2 < 1e-3 ? -sin2 * (1.0 + sin2 * (0.5 + sin2 / 3.0)) : log(max(1.0 - sin2, 1e-30));
  return (2.0 - ndf) / (2.0 * PI) * exp(-0.5 * ndf * log_cos2);
}

// The NDF under a light that is as wide, over half vectors, as an SG of sharpness λ' = 2/width: a Phong lobe
// of exponent n becomes one of n λ'/(n+λ'); GGX's α² grows by `width` in projected space, where α²/(1-α²)
// stands for α² and no lobe is wider than the hemisphere (Tokuyoshi and Kaplanyan 2021).
float filtered_ndf(float ndf, float width) {
  if (is_phong(ndf)) return ndf / (1.0 - 0.5 * ndf * width);
  float slope2 = ndf * ndf / max(1.0 - ndf * ndf, 1e-6) + width;
  return sqrt(slope2 / (1.0 + slope2));
}

// f(l,v) n·l; zero unless both directions are above the shading normal's and l above the face's horizon.
// `lobes`: those that the surface has (types.h), a constant.
vec3 brdf_cosine(Surface s, vec3 l, int lobes) {
  float nl = dot(s.normal, l);
  float nv = dot(s.normal, s.view);
  if (nl <= 0.0 || nv <= 0.0 || dot(s.geometric_normal, l) <= 0.0) return vec3(0.0);
  if ((lobes & SPECULAR_LOBE) == 0) return s.diffuse / PI * nl;
  vec3 h = safe_normalize(l + s.view, s.normal);
  float specular = ndf_value(s.ndf, s.normal, h) * smith_visibility(nl, nv, masking_alpha(s.ndf));
  return (s.diffuse / PI + specular * fresnel(s.f0, dot(l, h))) * nl;
}

#endif
