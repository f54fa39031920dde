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
#endif
}
