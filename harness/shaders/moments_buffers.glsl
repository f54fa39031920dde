// The moment pyramid as vec4 buffers from binding MOMENTS_BINDING on, one and two for each lobe of the
// lights, which the host binds together (MomentBuffers); what else a kernel binds comes before, or from
// AFTER_MOMENTS on. They are split to stay within a device's storage-buffer range at full resolution.
#ifndef VSGLBENCH_MOMENTS_BUFFERS_GLSL
#define VSGLBENCH_MOMENTS_BUFFERS_GLSL

#include "moments.glsl"

#define DIFFUSE_BINDING (MOMENTS_BINDING + 1)
#define SPECULAR_BINDING (DIFFUSE_BINDING + ((LIGHT_LOBES & DIFFUSE_LOBE) != 0 ? 2 : 0))
#define AFTER_MOMENTS (SPECULAR_BINDING + ((LIGHT_LOBES & SPECULAR_LOBE) != 0 ? 2 : 0))
layout(set = 0, binding = MOMENTS_BINDING, std430) buffer Places { vec4 places[]; };  // mean, variance
#if LIGHT_LOBES & DIFFUSE_LOBE
layout(set = 0, binding = DIFFUSE_BINDING, std430) buffer DiffusePowers { vec4 diffuse_powers[]; };
layout(set = 0, binding = DIFFUSE_BINDING + 1, std430) buffer DiffuseDirections {
  vec4 diffuse_directions[];
};  // direction, q
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
layout(set = 0, binding = SPECULAR_BINDING, std430) buffer SpecularPowers { vec4 specular_powers[]; };
layout(set = 0, binding = SPECULAR_BINDING + 1, std430) buffer SpecularDirections {
  vec4 specular_directions[];
};  // direction, q
#endif

Moments load_moments(uint i) {
  Moments m;
  vec4 place = places[i];
  m.mean = place.xyz;
  m.variance = place.w;
#if LIGHT_LOBES & DIFFUSE_LOBE
  vec4 d = diffuse_directions[i];
  m.diffuse = Lobe(diffuse_powers[i].rgb, d.xyz, d.w);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  vec4 s = specular_directions[i];
  m.specular = Lobe(specular_powers[i].rgb, s.xyz, s.w);
#endif
  return m;
}

void store_moments(uint i, Moments m) {
  places[i] = vec4(m.mean, m.variance);
#if LIGHT_LOBES & DIFFUSE_LOBE
  diffuse_powers[i] = vec4(m.diffuse.power, 0.0);
  diffuse_directions[i] = vec4(m.diffuse.direction, m.diffuse.q);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  specular_powers[i] = vec4(m.specular.power, 0.0);
  specular_directions[i] = vec4(m.specular.direction, m.specular.q);
#endif
}

#endif
