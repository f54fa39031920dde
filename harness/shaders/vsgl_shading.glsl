// One VSGL at one surface, without visibility.
#ifndef VSGLBENCH_VSGL_SHADING_GLSL
#define VSGLBENCH_VSGL_SHADING_GLSL

#include "disk.glsl"
#include "receiver.glsl"
#include "sg_diffuse.glsl"
#include "vpl_shading.glsl"
#include "vsgl14_shading.glsl"

// Which model: 0 vsgl16 [MFIS16 App. C, VSGL15s App. B]; 1 vsgl14 [VSGL14 §3.1]; 2 filtered, whose
// pixels have lights of their own (filtered_shading.glsl): importance is by vsgl14.
#ifndef SHADING_MODEL
#define SHADING_MODEL 0
#endif

// Which σ² of a light counts: 0 the paper's E|y-μ|² in three dimensions; 1 half of it, of a disk's two (as
// the author's later code has it) [light-transport §3].
#ifndef VARIANCE
#define VARIANCE 0
#endif

// Reflected radiance from incoming radiance c·G(ω;ξ,λ).
vec3 shade_sg(Receiver r, float amplitude, Sg sg) {
  // Diffuse: Rd/π A(λ) L(ξ,λ); the paper's L is the cosine pulled out of the integral [App. C.2]. Unlike the
  // paper, A(λ) stays exact: its 2π/λ grows without bound as λ → 0.
  float nl = dot(sg.axis, r.surface.normal);
  float integral = 2.0 * sg_integral_over_2pi(sg.sharpness) * sg_clamped_cosine(nl, sg.sharpness);
  return amplitude * (r.surface.diffuse * integral + receiver_specular(r, sg, max(nl, 0.0)));
}

// Both lobes of a light at distance √distance2 along `direction` [MFIS16 App. C].
vec3 shade_vsgl16(Receiver r, Vsgl light, vec3 direction, float distance2, float variance) {
  float sharpness = distance2 / variance;     // λ_σ, Eq. (11)
  float scale = 1.0 / (2.0 * PI * variance);  // Eq. (12)
  // The lights' own intensities come last: `scale` alone reaches 3.5e23, and what follows makes it small
  // again.
  vec3 sum = vec3(0.0);
#if LIGHT_LOBES & DIFFUSE_LOBE
  float log_d;
  Sg d = sg_product(direction, sharpness, -light.diffuse_axis, light.diffuse_sharpness, log_d);
  sum += light.diffuse * shade_sg(r, scale * exp(log_d), d);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  float log_s;
  Sg s = sg_product(direction, sharpness, -light.specular_axis, light.specular_sharpness, log_s);
  sum += light.specular * shade_sg(r, scale * exp(log_s), s);
#endif
  return sum;
}

// σ² as VARIANCE says, and no smaller than λ_σ <= 2^41 asks for: nothing overflows.
float shading_variance(Vsgl light, float distance2) {
#if VARIANCE == 1
  float variance = 0.5 * light.variance;
#else
  float variance = light.variance;
#endif
  return max(variance, distance2 * 4.5474735e-13);
}

// A light of no power gives black, whatever its other fields hold.
vec3 shade_vsgl(Receiver r, Vsgl light) {
  vec3 to_mean = light.mean - r.surface.position;
  float distance2 = max(dot(to_mean, to_mean), 1e-20);
  vec3 direction = to_mean * inversesqrt(distance2);
  float variance = shading_variance(light, distance2);
#if SHADING_MODEL >= 1
  vec3 sum = shade_vsgl14(r, light, direction, distance2, variance);
#else
  vec3 sum = shade_vsgl16(r, light, direction, distance2, variance);
#endif
  return light.power <= 0.0 ? vec3(0.0) : sum;
}

// Consistent bias reduction [VSGL14 §3.3]: whether ρ is smooth against the disk that the light is seen as,
// and may be pulled out of the integral: η_p < α·4π/|Ω|. η_p is the sharpness of the sharpest product of two
// lobes; an ASG of bandwidth η has sharpness 2η, a diffuse lobe of either end 0, so that a diffuse pair
// always cancels.
bool is_cancelled(Receiver r, Vsgl light, float alpha) {
  vec3 to_mean = light.mean - r.surface.position;
  float distance2 = max(dot(to_mean, to_mean), 1e-20);
  float radius2 = disk_radius2(light.variance, distance2);
  float receiver = 0.0, emitter = 0.0;
#if SURFACE_LOBES & SPECULAR_LOBE
  vec3 f0 = r.surface.f0;
  receiver = max(f0.r, max(f0.g, f0.b)) > 0.0 ? 2.0 * max(r.eta_x, r.eta_y) : 0.0;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  emitter = luminance(light.specular) > 0.0 ? light.specular_sharpness : 0.0;
#endif
  return (receiver + emitter) * solid_angle_over_area(sqrt(distance2), radius2) * radius2 < 4.0 * alpha;
}

// ρ(ω_i)|Ω|/(πr²) with the exact BRDFs, `texel` for the light's [VSGL14 §3.3].
vec3 shade_cancelled(Receiver r, Vsgl light, Vpl texel) {
  vec3 to_mean = light.mean - r.surface.position;
  float distance2 = max(dot(to_mean, to_mean), 1e-20);
  float radius2 = disk_radius2(light.variance, distance2);
  return vpl_rho(r.surface, texel, to_mean * inversesqrt(distance2)) *
         solid_angle_over_area(sqrt(distance2), radius2);
}

#endif
