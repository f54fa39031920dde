// A texel as a virtual point light that stands for `share` times its flux.
#ifndef VSGLBENCH_VPL_LIGHT_GLSL
#define VSGLBENCH_VPL_LIGHT_GLSL

#include "field.glsl"

Vpl make_vpl(Texel t, float share) {
  Vpl v;
  v.position = t.surface.position;
  v.ndf = t.surface.ndf;
  v.normal = t.surface.normal;
  v.geometric_normal = t.surface.geometric_normal;
  v.incident = t.surface.view;
  v.flux = share > 0.0 ? t.flux * share : vec3(0.0);
  v.power = luminance(v.flux);
  v.diffuse = t.surface.diffuse;
  v.f0 = t.surface.f0;
  v.radius = v.clamp = v.samples = v.unused0 = v.unused1 = 0.0;
  return v;
}

#endif
