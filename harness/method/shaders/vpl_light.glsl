// A texel as a virtual point light that stands for `share` times its flux.
#ifndef VSGLBENCH_VPL_LIGHT_GLSL
#define VSGLBENCH_VPL_LIGHT_GLSL

#include "field.glsl"

Vpl make_vpl(Texel t, float share) {
  Vpl v;
  v.position = t.surface.position;
  v.normal = t.surface.normal;
  v.geometric_normal = t.surface.geometric_normal;
  v.incident = t.surface.view;
  v.flux = share > 0.0 ? t.flux * share : vec3(0.0);
  v.power = luminance(v.flux);
#if LIGHT_LOBES & DIFFUSE_LOBE
  v.diffuse = t.surface.diffuse;
  v.unused0 = 0.0;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  v.ndf = t.surface.ndf;
  v.f0 = t.surface.f0;
  v.unused1 = 0.0;
#endif
  v.radius = v.clamp = v.samples = 0.0;
  return v;
}

#endif
