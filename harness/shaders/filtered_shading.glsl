// One VSGL at one surface by the exact BRDFs of both ends, their normal distributions filtered; without
// visibility. The light is the disk of r² = 2σ² [VSGL14 §3.1], but it lies across the light's mean normal,
// as the surface does that it stands for, and doesn't turn to face each receiver. Of
// ∫f_v f_x cosθ_v cosθ_x/d² dA/(πr²) both BRDFs are pulled out, as the consistent bias reduction pulls them
// out where they are smooth against the disk [VSGL14 §3.3]; here they are made smooth: over half vectors each
// NDF is as wide as itself and the disk together. What remains is closed (disk.glsl). As σ → 0 it is the
// point light [VSGL14 Eq. 1]. The errors against the integral are in harness/operation/approximations.csv,
// `filtered_brdfs`.
#ifndef VSGLBENCH_FILTERED_SHADING_GLSL
#define VSGLBENCH_FILTERED_SHADING_GLSL

#include "brdf.glsl"
#include "disk.glsl"

// f(l,v), without its cosine, under a light about l that is as wide as an SG of sharpness 1/spread: over half
// vectors that is 4 (v·h)/spread.
vec3 filtered_brdf(Surface s, vec3 l, float spread, int lobes) {
  vec3 diffuse = s.diffuse / PI;
  if ((lobes & SPECULAR_LOBE) == 0) return diffuse;
  float nl = dot(s.normal, l), nv = dot(s.normal, s.view);
  if (nl <= 0.0 || nv <= 0.0) return diffuse;
  vec3 sum = l + s.view;
  float length2 = max(dot(sum, sum), 4e-6), per_length = inversesqrt(length2);  // |l+v| = 2 v·h
  float ndf = filtered_ndf(s.ndf, spread * per_length);
  float specular = ndf_value(ndf, s.normal, sum * per_length) * smith_visibility(nl, nv, masking_alpha(ndf));
  return diffuse + specular * fresnel(s.f0, 0.5 * length2 * per_length);
}

vec3 shade_filtered(Surface s, FilteredLight light) {
  vec3 to_mean = light.mean - s.position;
  float height = -dot(to_mean, light.normal), rise = dot(to_mean, s.geometric_normal);
  if (height <= 0.0 || rise <= 0.0 || dot(s.normal, s.view) <= 0.0) return vec3(0.0);
  float distance2 = max(dot(to_mean, to_mean), 1e-18);
  float radius2 = disk_radius2(light.variance, distance2);
  vec3 flow = disk_flow(to_mean, distance2, light.normal, height, radius2);
  float tilt = dot(light.normal, s.geometric_normal);
  float reach2 = radius2 * max(1.0 - tilt * tilt, 1e-12);
  float transfer = above_horizon(flow, s.normal, radius2, rise * inversesqrt(reach2));
  vec3 direction = vec3(0.0);
  float spread = 0.0;
#if (SURFACE_LOBES | LIGHT_LOBES) & SPECULAR_LOBE
  float per_distance = inversesqrt(distance2);
  direction = to_mean * per_distance;
  spread = 0.25 * solid_angle_over_area(distance2 * per_distance, radius2) * radius2;  // |Ω|/4π
#endif
  vec3 emitted = vec3(0.0);
#if LIGHT_LOBES & DIFFUSE_LOBE
  emitted += light.diffuse;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  Surface mirror =
      Surface(light.mean, light.normal, light.normal, light.incident, vec3(0.0), light.f0, light.ndf);
  emitted += light.flux * filtered_brdf(mirror, -direction, spread, SPECULAR_LOBE);
#endif
  return transfer * emitted * filtered_brdf(s, direction, spread, SURFACE_LOBES);
}

#endif
