// The shading point as VSGLs see it: its specular lobe as an anisotropic SG [VSGL15s App. B, MFIS16 App.
// C.2].
#ifndef VSGLBENCH_RECEIVER_GLSL
#define VSGLBENCH_RECEIVER_GLSL

#include "asg.glsl"
#include "brdf.glsl"
#include "sg.glsl"
#include "types.h"

// What the specular lobe is: 0 asg, an anisotropic SG; 1 sg, the BRDF itself with its NDF widened by the
// light's SG; 2 isotropic, one SG about the mirror direction.
#ifndef RECEIVER_LOBE
#define RECEIVER_LOBE 0
#endif

// The receiver's specular lobe as an anisotropic SG [MFIS16 App. C.2; Xu et al. 2013]:
// C(ω) max(ω·z,0) exp(-ηx(ω·x)² - ηy(ω·y)²), x in the plane of incidence, z the mirror direction. Turning ω
// by δ turns the half vector by δ/2 in that plane and by δ/(2 n·v) across it, so ηx = λh/8 and ηy = λh/(8
// (n·v)²).
struct Receiver {
  Surface surface;
#if SURFACE_LOBES & SPECULAR_LOBE
  vec3 x, y, z;
  float eta_x, eta_y;
  float nv, alpha, peak;
#endif
};

Receiver make_receiver(Surface s) {
  Receiver r;
  r.surface = s;
#if SURFACE_LOBES & SPECULAR_LOBE
  r.nv = max(dot(s.normal, s.view), 0.01);
  r.z = reflect(-s.view, s.normal);
  vec3 perpendicular = cross(s.normal, s.view);  // no plane of incidence when looking straight down
  vec3 any = abs(s.normal.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  r.y =
      dot(perpendicular, perpendicular) > 1e-10 ? normalize(perpendicular) : normalize(cross(s.normal, any));
  r.x = cross(r.y, r.z);
  float sharpness = ndf_sharpness(s.ndf);
  r.eta_x = sharpness / 8.0;
  r.eta_y = sharpness / (8.0 * r.nv * r.nv);
  r.alpha = masking_alpha(s.ndf);
  r.peak = ndf_peak(s.ndf);
#endif
  return r;
}

#if SURFACE_LOBES & SPECULAR_LOBE
// ∫ G(ω;ξ,λ) D(h(ω)) of the NDF D: SG × ASG [VSGL15s App. B].
float receiver_asg(Receiver r, Sg sg) {
  vec3 local = vec3(dot(sg.axis, r.x), dot(sg.axis, r.y), dot(sg.axis, r.z));
  return r.peak * asg_product(local, sg.sharpness, r.eta_x, r.eta_y);
}

// The same by filtering the NDF: over the half vector the light's SG has the sharpness 4 (v·h) λ (the
// Jacobian of the reflection, 1/(4 v·h), is taken as equal in both directions, where it is 1/4 and 1/(4
// (v·h)²)). As λ → ∞ it is D(h) itself; under wide lights it is too bright, by up to 50 %
// (harness/operation/approximations.csv, `filtered`), more at grazing views.
float receiver_filtered(Receiver r, Sg sg, float vh) {
  float wide = max(4.0 * vh * sg.sharpness, 1e-6);
  vec3 h = safe_normalize(sg.axis + r.surface.view, r.surface.normal);
  return sg_integral(sg.sharpness) * ndf_value(filtered_ndf(r.surface.ndf, 2.0 / wide), r.surface.normal, h);
}

// The same by one SG about the mirror direction, of sharpness λh/(4 n·v) [VSGL15s App. A; MFIS16 App. A.1]:
// as wide in both directions as the ASG is in their geometric mean. What the papers call less accurate at
// grazing views than an anisotropic one.
float receiver_isotropic(Receiver r, Sg sg) {
  float log_amplitude;
  Sg product = sg_product(r.z, 2.0 * sqrt(r.eta_x) * sqrt(r.eta_y), sg.axis, sg.sharpness, log_amplitude);
  return r.peak * exp(log_amplitude) * sg_integral(product.sharpness);
}
#endif

// ∫ G(ω;ξ,λ) of the specular lobe, with V · F · `cosine` pulled out of the integral at the SG's axis; 0 where
// no surface has one.
vec3 receiver_specular(Receiver r, Sg sg, float cosine) {
#if SURFACE_LOBES & SPECULAR_LOBE
  float vh = 0.5 * length(sg.axis + r.surface.view);  // cosine of the half angle
#if RECEIVER_LOBE == 1
  float lobe = receiver_filtered(r, sg, vh);
#elif RECEIVER_LOBE == 2
  float lobe = receiver_isotropic(r, sg);
#else
  float lobe = receiver_asg(r, sg);
#endif
  return fresnel(r.surface.f0, vh) * (smith_visibility(cosine, r.nv, r.alpha) * cosine * lobe);
#else
  return vec3(0.0);
#endif
}

#endif
