// Lights of either kind as shading sees them. LIGHT_VPL 1: Vpl, 0: Vsgl.
#include "vsgl_shading.glsl"

#if LIGHT_VPL
#define Light Vpl
#define Shader Surface
Shader make_shader(Surface s) { return s; }

// Φ f(x2) f(x1) cos cos / d² [VSGL14 Eq. 1].
vec3 shade_light(Shader s, Vpl light) {
  vec3 to_light = light.position - s.position;
  float distance2 = dot(to_light, to_light);
  if (light.power <= 0.0 || distance2 <= 0.0) return vec3(0.0);
  vec3 direction = to_light * inversesqrt(distance2);
  Surface emitter = Surface(light.position, light.normal, light.geometric_normal, light.incident, light.diffuse,
                            light.f0, light.ndf);
  return light.flux * brdf_cosine(emitter, -direction) * brdf_cosine(s, direction) / distance2;
}
#else
#define Light Vsgl
#define Shader Receiver
Shader make_shader(Surface s) { return make_receiver(s); }
vec3 shade_light(Shader r, Vsgl light) { return shade_vsgl(r, light); }
#endif
