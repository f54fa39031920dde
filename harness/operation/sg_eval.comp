#version 460
// Rows of arguments to one operation of harness/shaders, in single precision, for `vsglbench sg` and its
// tests. FUNCTION as in sg_evaluation.h; COLUMNS floats a row in, RESULTS out.
layout(local_size_x = 64) in;

#include "asg.glsl"
#include "sg.glsl"
#include "sg_diffuse.glsl"
#if FUNCTION >= 14
#include "vsgl_shading.glsl"
#endif

layout(set = 0, binding = 0, std430) readonly buffer Arguments { float arguments[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Push { uint rows; };

float argument(uint column) { return arguments[gl_GlobalInvocationID.x * COLUMNS + column]; }
vec3 vector(uint column) { return vec3(argument(column), argument(column + 1), argument(column + 2)); }
void result(uint column, float value) { values[gl_GlobalInvocationID.x * RESULTS + column] = value; }

void main() {
  if (gl_GlobalInvocationID.x >= rows) return;
#if FUNCTION == 0
  result(0, sg_clamped_cosine(argument(0), argument(1)));
#elif FUNCTION == 1
  result(0, sg_integral(argument(0)));
#elif FUNCTION == 2
  float log_amplitude;
  Sg product = sg_product(vector(0), argument(3), vector(4), argument(7), log_amplitude);
  result(0, log_amplitude);
  result(1, product.sharpness);
#elif FUNCTION == 3
  result(0, normalized_hemisphere(argument(0), argument(1)));
#elif FUNCTION == 4
  result(0, asg_product_compensated(vector(0), argument(3), argument(4), argument(5)));
#elif FUNCTION == 5
  result(0, toksvig_sharpness(toksvig_complement(argument(0))));
#elif FUNCTION == 6
  result(0, sg_value(vector(0), Sg(vector(4), argument(7))));
#elif FUNCTION == 7
  result(0, banerjee_sharpness(argument(0)));
#elif FUNCTION == 8
  result(0, vmf_complement(argument(0)));
#elif FUNCTION == 9
  result(0, erf(argument(0)));
#elif FUNCTION == 10
  result(0, erfc(argument(0)));
#elif FUNCTION == 11
  result(0, expm1_over_x(argument(0)));
#elif FUNCTION == 12
  result(0, exp_accurate(argument(0)));
#elif FUNCTION == 13
  result(0, asg_product(vector(0), argument(3), argument(4), argument(5)));
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
#elif FUNCTION == 15
  Surface surface =
      Surface(vec3(0.0), vector(4), vector(4), vector(7), vec3(0.0), vec3(argument(10)), argument(11));
  result(0, shade_sg(make_receiver(surface), 1.0, Sg(vector(0), argument(3))).x);
#endif
}
