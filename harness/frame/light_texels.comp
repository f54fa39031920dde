// The RSM texel that stands for each light: the one that the primary light sees its mean through. Where every
// texel is a light of its own that is the light's texel.
//  * `texels`: its exact BRDF, with the light's whole flux, for the consistent bias reduction [VSGL14 §3.3].
//    Unlike the paper, which filters BRDF parameters, the BRDF is a texel's: with N it converges to the same.
//  * LOBE_FILTER 1: the light's specular lobe becomes that texel's, unfiltered, of the same power [VSGL14
//  Fig. 3a].
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "field_maps.glsl"
#include "field.glsl"
#include "vpl_light.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) buffer Lights { Vsgl lights[]; };
layout(set = 0, binding = AFTER_MAPS + 1, scalar) writeonly buffer Texels { Vpl texels[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;
};

#include "light_texel.glsl"

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Vsgl light = lights[i];
  vec3 reflected = vec3(0.0);
#if LIGHT_LOBES & DIFFUSE_LOBE
  reflected += light.diffuse * sg_integral(light.diffuse_sharpness);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  vec3 specular = light.specular * sg_integral(light.specular_sharpness);
  reflected += specular;
#endif
  Texel t;
  bool lit = light.power > 0.0;
  bool surface = load_texel(emitter, lit ? texel_of(light.mean) : ivec2(0), t) && lit;
  Vpl v = make_vpl(t, 0.0);
  v.flux = flux_behind(reflected, t.surface.diffuse + specular_reflectance(t.surface));
  v.power = surface ? luminance(v.flux) : 0.0;
  texels[i] = v;
#if LOBE_FILTER == 1 && (LIGHT_LOBES & SPECULAR_LOBE) != 0
  if (!surface) return;
  Moments m = leaf_moments(t);
  light.specular_axis = safe_normalize(m.specular.direction, light.specular_axis);
  light.specular_sharpness = lobe_sharpness(m.specular.q);
  light.specular = specular / sg_integral(light.specular_sharpness);
  lights[i] = light;
#endif
}
