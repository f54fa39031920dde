// The record of a kind of light, and what every kind says of its place. LIGHT_VPL 1: Vpl, 0: Vsgl, or with
// LIGHT_FILTERED 1 FilteredLight, which shading alone reads.
#ifndef VSGLBENCH_LIGHT_RECORD_GLSL
#define VSGLBENCH_LIGHT_RECORD_GLSL

#include "types.h"

#ifndef LIGHT_FILTERED
#define LIGHT_FILTERED 0
#endif
#if LIGHT_VPL
#define Light Vpl
vec3 light_position(Light light) { return light.position; }
// What its shadow map is about; w 0: it shines into the hemisphere about xyz, 1: into all directions.
vec4 light_axis(Light light) { return vec4(light.geometric_normal, 0.0); }
// σ of a cluster, m; 0: a point.
float light_sigma(Light light) { return 0.0; }
// The same light with its extent, squared, times `factor`.
Light scaled(Light light, float factor) {
  light.radius *= sqrt(factor);
  return light;
}
#elif LIGHT_FILTERED
#define Light FilteredLight
Light scaled(Light light, float factor) {
  light.variance *= factor;
  return light;
}
#else
#define Light Vsgl
vec3 light_position(Light light) { return light.mean; }
vec4 light_axis(Light light) {
#if LIGHT_LOBES & DIFFUSE_LOBE
  return vec4(light.diffuse_axis, 1.0);
#else
  return vec4(light.specular_axis, 1.0);
#endif
}
float light_sigma(Light light) { return sqrt(light.variance); }
Light scaled(Light light, float factor) {
  light.variance *= factor;
  return light;
}
#endif

#endif
