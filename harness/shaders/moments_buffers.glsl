// The moment pyramid as five vec4 buffers from binding MOMENTS_BINDING on, which the host binds together
// (MomentBuffers); what else a kernel binds comes before, or from AFTER_MOMENTS on. They are split to stay
// within a device's storage-buffer range at full resolution.
#ifndef VSGLBENCH_MOMENTS_BUFFERS_GLSL
#define VSGLBENCH_MOMENTS_BUFFERS_GLSL

#include "moments.glsl"

#define AFTER_MOMENTS (MOMENTS_BINDING + 5)
layout(set = 0, binding = MOMENTS_BINDING + 0, std430) buffer Moments0 { vec4 moments0[]; };  // Pd, variance
layout(set = 0, binding = MOMENTS_BINDING + 1, std430) buffer Moments1 { vec4 moments1[]; };  // Ps
layout(set = 0, binding = MOMENTS_BINDING + 2, std430) buffer Moments2 { vec4 moments2[]; };  // mean
layout(set = 0, binding = MOMENTS_BINDING + 3, std430) buffer Moments3 {
  vec4 moments3[];
};  // diffuse direction, q
layout(set = 0, binding = MOMENTS_BINDING + 4, std430) buffer Moments4 {
  vec4 moments4[];
};  // specular direction, q

Moments load_moments(uint i) {
  vec4 a = moments0[i], b = moments1[i], c = moments2[i], d = moments3[i], e = moments4[i];
  return Moments(Lobe(a.rgb, d.xyz, d.w), Lobe(b.rgb, e.xyz, e.w), c.xyz, a.w);
}

void store_moments(uint i, Moments m) {
  moments0[i] = vec4(m.diffuse.power, m.variance);
  moments1[i] = vec4(m.specular.power, 0.0);
  moments2[i] = vec4(m.mean, 0.0);
  moments3[i] = vec4(m.diffuse.direction, m.diffuse.q);
  moments4[i] = vec4(m.specular.direction, m.specular.q);
}

#endif
