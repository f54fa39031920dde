// Tests only: the directions that virtual spherical lights are sampled by, and their densities. MODE 0: the
// BRDF's density in direction `given.xyz`; 1: a direction drawn with u = given.xy, choose = given.z, and its
// density; 2: one uniform in the cone about the normal with 1-cosθ = `cone`, and whether it counts as inside.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "vsl_shading.glsl"
#ifndef MODE
#define MODE 0
#endif
layout(set = 0, binding = 0, std430) readonly buffer Given { vec4 given[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Values { vec4 values[]; };
layout(push_constant, scalar) uniform Push {
  vec3 normal;
  float ndf;
  vec3 view;
  float cone;
  vec3 diffuse;
  uint count;
  vec3 f0;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Surface s = Surface(vec3(0.0), normal, normal, view, diffuse, f0, ndf);
#if MODE == 0
  values[i] = vec4(given[i].xyz, brdf_pdf(s, given[i].xyz, SURFACE_LOBES));
#elif MODE == 1
  vec3 l = sample_brdf(s, given[i].xy, given[i].z, SURFACE_LOBES);
  values[i] = vec4(l, brdf_pdf(s, l, SURFACE_LOBES));
#else
  Cone c = Cone(normal, cone);
  vec3 l = sample_cone(c, given[i].xy);
  values[i] = vec4(l, in_cone(c, l) ? cone_pdf(c) : 0.0);
#endif
}
