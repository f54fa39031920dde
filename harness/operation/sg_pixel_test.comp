#version 460
// Tests only: a light made from moments, shaded at a diffuse surface. A row: cosine of the light's direction
// at the surface, the light's distance and variance, 1-r of its diffuse lobe, which points at the surface.
// Results: red of the reflected radiance, the lobe's sharpness, and 1-r of a texel's lobe whose sharpness is
// the second argument.
layout(local_size_x = 64) in;

#include "moments.glsl"
#include "vsgl_shading.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Arguments { float arguments[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Push { uint rows; };

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= rows) return;
  float cosine = arguments[4 * row];
  vec3 direction = vec3(sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0, cosine);
  Moments m = empty_moments();
  m.mean = arguments[4 * row + 1] * direction;
  m.variance = arguments[4 * row + 2];
  m.diffuse = Lobe(vec3(1.0), -(1.0 - arguments[4 * row + 3]) * direction, arguments[4 * row + 3]);
  Surface s;
  s.position = vec3(0.0);
  s.normal = s.geometric_normal = s.view = vec3(0.0, 0.0, 1.0);
  s.diffuse = vec3(1.0);
  s.f0 = vec3(0.0);
  s.ndf = 0.5;
  Vsgl light = make_vsgl(m, 1.0, 0.0);
  values[3 * row] = shade_vsgl(make_receiver(s), light).r;
  values[3 * row + 1] = light.diffuse_sharpness;
  values[3 * row + 2] = lobe_complement(arguments[4 * row + 1]);
}
