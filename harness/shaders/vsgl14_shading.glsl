// One VSGL at one surface by the first form of the model [VSGL14 §3.1]: ∫ρ(ω)V(ω)dω / (πr²) with the disk's
// visibility as an SG, V ≈ 2 G(ω; ω_i, 4π/|Ω|), cosines pulled out of the integral, and r² = 2σ².
#ifndef VSGLBENCH_VSGL14_SHADING_GLSL
#define VSGLBENCH_VSGL14_SHADING_GLSL

#include "disk.glsl"
#include "receiver.glsl"

vec3 shade_vsgl14(Receiver r, Vsgl light, vec3 direction, float distance2, float variance) {
  float radius2 = 2.0 * variance;
  float per_area = solid_angle_over_area(sqrt(distance2), radius2);
  Sg disk = Sg(direction, 4.0 / (per_area * radius2));  // 4π/|Ω|
  float nl = max(dot(direction, r.surface.normal), 0.0);
  float area = PI * radius2;
  // The light's diffuse lobe has sharpness 0, and its cosine is pulled out [§3.1]: its power over π, times
  // the cosine.
  vec3 diffuse_receiver = r.surface.diffuse * (nl / PI);
  vec3 sum = vec3(0.0);
#if LIGHT_LOBES & DIFFUSE_LOBE
  float emitted = max(dot(-direction, light.diffuse_axis), 0.0);
  vec3 diffuse_light = light.diffuse * (sg_integral(light.diffuse_sharpness) * emitted / PI);
  sum += (diffuse_receiver * sg_integral(disk.sharpness) + receiver_specular(r, disk, nl)) * diffuse_light;
#endif
  // Its specular one is a normalised SG with the cosine within [MFIS16 Eq. 7].
#if LIGHT_LOBES & SPECULAR_LOBE
  float log_s;
  Sg s = sg_product(disk.axis, disk.sharpness, -light.specular_axis, light.specular_sharpness, log_s);
  vec3 specular_light = light.specular * exp(log_s);
  sum += (diffuse_receiver * sg_integral(s.sharpness) + receiver_specular(r, s, nl)) * specular_light;
#endif
  return 2.0 / area * sum;
}

#endif
