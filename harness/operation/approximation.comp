#version 460
// One light at one surface a row, by the functions that the pixels call. MODE 0: a VSGL. 1: a cancelled pair;
// w = 1 where bias reduction at `alpha` cancels it. 2: a virtual spherical light, `runs` independent
// estimates a row. 3: a VSGL by filtered BRDFs.
#include "types.h"
layout(local_size_x = 64) in;
#include "filtered_shading.glsl"
#include "vsgl_shading.glsl"
#if MODE == 2
#include "vsl_shading.glsl"
#endif
layout(set = 0, binding = 0, scalar) readonly buffer Surfaces { Vpl surfaces[]; };  // power and flux unused
layout(set = 0, binding = 1, scalar) readonly buffer Lights { Vsgl lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Texels { Vpl texels[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Values { vec4 values[]; };
layout(push_constant) uniform Push {
  uint count, runs;
  float alpha;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count * runs) return;
  uint row = i / runs;
  Surface surface = vpl_surface(surfaces[row]);
#if MODE == 0
  values[i] = vec4(shade_vsgl(make_receiver(surface), lights[row]), 0.0);
#elif MODE == 1
  Receiver r = make_receiver(surface);
  values[i] =
      vec4(shade_cancelled(r, lights[row], texels[row]), is_cancelled(r, lights[row], alpha) ? 1.0 : 0.0);
#elif MODE == 3
  Vsgl light = lights[row];
  Vpl t = texels[row];
  FilteredLight f = FilteredLight(light.mean, light.variance, t.normal, t.flux * t.diffuse / PI, t.ndf,
                                  t.incident, t.flux, t.f0);
  values[i] = vec4(shade_filtered(surface, f), 0.0);
#else
  values[i] = vec4(shade_vsl(surface, texels[row], random_hash(uvec2(i, 77u))), 0.0);
#endif
}
