// The shading point as VSGLs see it: its specular lobe as an anisotropic SG [VSGL15s App. B, MFIS16 App. C.2].
#ifndef VSGLBENCH_RECEIVER_GLSL
#define VSGLBENCH_RECEIVER_GLSL

#include "asg.glsl"
#include "brdf.glsl"
#include "sg.glsl"
#include "types.h"

// The receiver's specular lobe as an anisotropic SG [MFIS16 App. C.2; Xu et al. 2013]:
// C(ω) max(ω·z,0) exp(-ηx(ω·x)² - ηy(ω·y)²), x in the plane of incidence, z the mirror direction. Turning ω by δ turns
// the half vector by δ/2 in that plane and by δ/(2 n·v) across it, so ηx = λh/8 and ηy = λh/(8 (n·v)²).
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
  r.eta_x = sharpness / 8.0;
  r.eta_y = sharpness / (8.0 * r.nv * r.nv);
  r.alpha = masking_alpha(s.ndf);
  r.peak = ndf_peak(s.ndf);
  return r;
}

// ∫ G(ω;ξ,λ) of the specular lobe: SG × ASG [VSGL15s App. B], with C = peak · V · F · `cosine` at the SG's axis.
vec3 receiver_specular(Receiver r, Sg sg, float cosine) {
  vec3 local = vec3(dot(sg.axis, r.x), dot(sg.axis, r.y), dot(sg.axis, r.z));
  float lobe = asg_product(local, sg.sharpness, r.eta_x, r.eta_y);
  float vh = 0.5 * length(sg.axis + r.surface.view);  // cosine of the half angle
  float c = r.peak * smith_visibility(cosine, r.nv, r.alpha) * cosine;
  return fresnel(r.surface.f0, vh) * (c * lobe);
}

#endif
