// One VSGL at one surface, without visibility [MFIS16 App. C, VSGL15s App. B].
#ifndef VSGLBENCH_VSGL_SHADING_GLSL
#define VSGLBENCH_VSGL_SHADING_GLSL

#include "asg.glsl"
#include "brdf.glsl"
#include "sg.glsl"
#include "sg_diffuse.glsl"
#include "types.h"

// Which σ² of a light counts: 0 the paper's E|y-μ|² in three dimensions; 1 half of it, of a disk's two (as the
// author's later code has it) [light-transport §3].
#ifndef VARIANCE
#define VARIANCE 0
#endif

// The receiver's specular lobe as an anisotropic SG [MFIS16 App. C.2; Xu et al. 2013]:
// C(ω) max(ω·z,0) exp(-ηx(ω·x)² - ηy(ω·y)²), x in the plane of incidence, z the mirror direction.
struct Receiver {
  Surface surface;
  vec3 x, y, z;
  float eta_x, eta_y;
  float nv, alpha, peak;
};

Receiver make_receiver(Surface s) {
  Receiver r;
  r.surface = s;
  r.nv = max(dot(s.normal, s.view), 0.01);
  r.z = reflect(-s.view, s.normal);
  vec3 perpendicular = cross(s.normal, s.view);  // no plane of incidence when looking straight down
  vec3 any = abs(s.normal.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  r.y = dot(perpendicular, perpendicular) > 1e-10 ? normalize(perpendicular) : normalize(cross(s.normal, any));
  r.x = cross(r.y, r.z);
  float sharpness = ndf_sharpness(s.ndf);
  r.eta_x = sharpness / (8.0 * r.nv * r.nv);
  r.eta_y = sharpness / 8.0;
  r.alpha = masking_alpha(s.ndf);
  r.peak = ndf_peak(s.ndf);
  return r;
}

// Reflected radiance from incoming radiance c·G(ω;ξ,λ).
vec3 shade_sg(Receiver r, vec3 amplitude, Sg sg) {
  // Diffuse: Rd/π A(λ) L(ξ,λ); the paper's L is the cosine pulled out of the integral [App. C.2]. Unlike the
  // paper, A(λ) stays exact: its 2π/λ grows without bound as λ → 0.
  float nl = dot(sg.axis, r.surface.normal);
  float integral = 2.0 * sg_integral_over_2pi(sg.sharpness) * sg_clamped_cosine(nl, sg.sharpness);
  vec3 diffuse = r.surface.diffuse * integral;
  // Specular: SG × ASG [VSGL15s App. B], with C(ξ) = peak · V · F · n·l.
  vec3 local = vec3(dot(sg.axis, r.x), dot(sg.axis, r.y), dot(sg.axis, r.z));
  float lobe = asg_product(local, sg.sharpness, r.eta_x, r.eta_y);
  float cosine = max(nl, 0.0);
  float vh = sqrt(max(0.5 + 0.5 * dot(sg.axis, r.surface.view), 0.0));  // cosine of the half angle
  float c = r.peak * smith_visibility(cosine, r.nv, r.alpha) * cosine;
  vec3 specular = fresnel(r.surface.f0, vh) * (c * lobe);
  return amplitude * (diffuse + specular);
}

// Both lobes of a light. `nothing` comes back for a light of no power.
vec3 shade_vsgl(Receiver r, Vsgl light) {
  vec3 to_mean = light.mean - r.surface.position;
  float distance2 = max(dot(to_mean, to_mean), 1e-20);
  vec3 direction = to_mean * inversesqrt(distance2);
#if VARIANCE == 1
  float variance = 0.5 * light.variance;
#else
  float variance = light.variance;
#endif
  variance = max(variance, distance2 * 4.5474735e-13);  // λ_σ <= 2^41: nothing below overflows
  float sharpness = distance2 / variance;     // λ_σ, Eq. (11)
  float scale = 1.0 / (2.0 * PI * variance);  // Eq. (12)
  float log_d, log_s;
  Sg d = sg_product(direction, sharpness, -light.diffuse_axis, light.diffuse_sharpness, log_d);
  Sg s = sg_product(direction, sharpness, -light.specular_axis, light.specular_sharpness, log_s);
  vec3 sum = shade_sg(r, light.diffuse * (scale * exp(log_d)), d);
  sum += shade_sg(r, light.specular * (scale * exp(log_s)), s);
  return light.power <= 0.0 ? vec3(0.0) : sum;
}

#endif
