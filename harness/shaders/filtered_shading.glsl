// One VSGL at one surface by the exact BRDFs of both ends, their normal distributions filtered; without
// visibility. The light is the disk of r² = 2σ² that [VSGL14 §3.1] sees it as. Of ∫ρ(ω)V(ω)dω/(πr²)
// [VSGL14 Eq. 2], ρ is pulled out of the integral, as the consistent bias reduction does where ρ is smooth
// against the disk [VSGL14 §3.3]; here ρ is made smooth: over half vectors each NDF is as wide as itself and
// the disk together. As σ → 0 it is the point light [VSGL14 Eq. 1]. Against the integral it errs by 1 % and
// less where r is 0.03 d and no angle is grazing, and is too bright by 4 % (Lambert) to 55 % (lobes) where r
// is 0.3 d (harness/operation/approximations.csv, `filtered_brdfs`).
#ifndef VSGLBENCH_FILTERED_SHADING_GLSL
#define VSGLBENCH_FILTERED_SHADING_GLSL

#include "brdf.glsl"
#include "disk.glsl"

// f(l,v) n·l under a light about l that is as wide as an SG of sharpness 1/spread: over half vectors that is
// 4 (v·h)/spread.
vec3 filtered_brdf_cosine(Surface s, vec3 l, float spread, int lobes) {
  if ((lobes & SPECULAR_LOBE) != 0) {
    float vh = max(0.5 * length(l + s.view), 1e-3);
    s.ndf = filtered_ndf(s.ndf, 0.5 * spread / vh);
  }
  return brdf_cosine(s, l, lobes);
}

vec3 shade_filtered(Surface s, FilteredLight light) {
  vec3 to_mean = light.mean - s.position;
  float distance2 = max(dot(to_mean, to_mean), 1e-20);
  vec3 direction = to_mean * inversesqrt(distance2);
  float radius2 = disk_radius2(light.variance, distance2);
  float per_area = solid_angle_over_area(sqrt(distance2), radius2);
  float spread = 0.25 * per_area * radius2;  // |Ω|/4π
  vec3 emitted = vec3(0.0);
#if LIGHT_LOBES & DIFFUSE_LOBE
  emitted += light.diffuse * max(dot(-direction, light.normal), 0.0);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  Surface mirror =
      Surface(light.mean, light.normal, light.normal, light.incident, vec3(0.0), light.f0, light.ndf);
  emitted += light.flux * filtered_brdf_cosine(mirror, -direction, spread, SPECULAR_LOBE);
#endif
  return per_area * emitted * filtered_brdf_cosine(s, direction, spread, SURFACE_LOBES);
}

#endif
