// VSGLs as `shading` filtered evaluates them: each with the material of the RSM's texel at its mean and with
// all of its own power, turned as its surfaces are on average, its normal distribution wider by what its lobe
// is wider than that texel's. One that reflects no diffuse light is turned as a mirror would be of that lobe.
// Where the primary light sees no surface at the mean, the light is a Lambert surface, or black in a scene
// that has no diffuse emitters.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) readonly buffer Lights { Vsgl lights[]; };
layout(set = 0, binding = AFTER_MAPS + 1, scalar) writeonly buffer Filtered { FilteredLight filtered[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;
};
#include "light_texel.glsl"

#if LIGHT_LOBES & SPECULAR_LOBE
// The specular lobe of `s`, lit from `incident`, for a light that reflects by a lobe of this sharpness.
float ndf_of_lights(Surface s, float cosine, float sharpness) {
  float own = 4.0 * cosine / ndf_sharpness(s.ndf);  // 1/λ of the texel's own lobe [VSGL15s App. A]
  float wider = max(1.0 / max(sharpness, 1e-3) - own, 0.0);
  return filtered_ndf(s.ndf, 0.5 * wider / cosine);
}
#endif

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Vsgl light = lights[i];
  bool lit = light.power > 0.0;
  Texel t;
  bool surface = load_texel(emitter, lit ? texel_of(light.mean) : ivec2(0), t) && lit;
  FilteredLight f;
  f.mean = light.mean;
  f.variance = light.variance;
  vec3 reflected = vec3(0.0), reflectance = vec3(0.0);
#if LIGHT_LOBES & DIFFUSE_LOBE
  vec3 diffuse = lit ? light.diffuse * sg_integral(light.diffuse_sharpness) : vec3(0.0);
  reflected += diffuse;
  reflectance += t.surface.diffuse;
  bool has_mean_normal = !surface || luminance(diffuse) > 0.0;
  f.normal = has_mean_normal ? light.diffuse_axis : t.surface.normal;
#elif LIGHT_LOBES & SPECULAR_LOBE
  f.normal = surface ? t.surface.normal : light.specular_axis;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  vec3 mirrored = lit ? light.specular * sg_integral(light.specular_sharpness) : vec3(0.0);
  bool is_mirror = luminance(mirrored) > 0.0 && !(luminance(reflected) > 0.0);
  reflected += mirrored;
  reflectance += specular_reflectance(t.surface);
  vec3 incident =
      emitter.perspective != 0u ? safe_normalize(emitter.position - light.mean, f.normal) : -emitter.forward;
  bool has_lobe = surface && luminance(specular_reflectance(t.surface)) > 0.0;
  vec3 half_way = safe_normalize(incident + light.specular_axis, f.normal);
  if (is_mirror) f.normal = has_lobe ? half_way : light.specular_axis;
  // A lit surface faces the primary light; where the mean of many doesn't quite, it is lit at a grazing
  // angle.
  float cosine = dot(f.normal, incident);
  f.incident = cosine < 0.01 ? normalize(incident + (0.01 - cosine) * f.normal) : incident;
  f.flux = surface ? flux_behind(reflected, reflectance) : vec3(0.0);
  f.f0 = surface ? t.surface.f0 : vec3(0.0);
  f.ndf = surface ? ndf_of_lights(t.surface, max(cosine, 0.01), light.specular_sharpness) : 1.0;
#if LIGHT_LOBES & DIFFUSE_LOBE
  f.diffuse = (surface ? f.flux * t.surface.diffuse : reflected) / PI;
#endif
#else
  f.diffuse = reflected / PI;
#endif
  filtered[i] = f;
}
