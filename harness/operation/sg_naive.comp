#version 460
// Tests only: the textbook forms, which cancel, in place of those of harness/shaders/sg.glsl. Interface of
// sg_eval.comp.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer Arguments { float arguments[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Push { uint rows; };

float argument(uint column) { return arguments[gl_GlobalInvocationID.x * COLUMNS + column]; }
vec3 vector(uint column) { return vec3(argument(column), argument(column + 1), argument(column + 2)); }
void result(uint column, float value) { values[gl_GlobalInvocationID.x * RESULTS + column] = value; }

#if FUNCTION == 14
#include "sg.glsl"
Sg naive_product(vec3 axis1, float sharpness1, vec3 axis2, float sharpness2, out float log_amplitude) {
  vec3 sum = sharpness1 * axis1 + sharpness2 * axis2;
  float sharpness = length(sum);
  log_amplitude = sharpness - sharpness1 - sharpness2;
  return Sg(sum / sharpness, sharpness);
}
#define sg_product naive_product
#include "vsgl_shading.glsl"
#endif

void main() {
  if (gl_GlobalInvocationID.x >= rows) return;
#if FUNCTION == 1
  float sharpness = argument(0);
  result(0, 2.0 * 3.14159265 * (1.0 - exp(-2.0 * sharpness)) / sharpness);
#elif FUNCTION == 2
  float sharpness = length(argument(3) * vector(0) + argument(7) * vector(4));
  result(0, sharpness - argument(3) - argument(7));
  result(1, sharpness);
#elif FUNCTION == 6
  result(0, exp(argument(7) * (dot(vector(0), vector(4)) - 1.0)));
#elif FUNCTION == 14
  Surface surface = Surface(vec3(0.0), vector(14), vector(14), vector(17), vec3(argument(20)),
                            vec3(argument(21)), argument(22));
  Vsgl light;
  light.mean = vector(0);
  light.variance = argument(3);
  light.diffuse_axis = vector(4);
  light.diffuse_sharpness = argument(7);
  light.specular_axis = vector(8);
  light.specular_sharpness = argument(11);
  light.diffuse = vec3(argument(12));
  light.specular = vec3(argument(13));
  light.level = -1.0;
  light.power = 1.0;
  result(0, shade_vsgl(make_receiver(surface), light).x);
#endif
}
