// Tests only: one element an invocation, of floats beside bits that are none. AT: the element that goes bad.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
struct Mixed {
  uint bits;
  vec3 mean;
  float power;
};
layout(set = 0, binding = 0, std430) readonly buffer From { float from[]; };
layout(set = 0, binding = 1, scalar) buffer To {
  uint head;
  float total;
  Mixed to[];
};
layout(push_constant) uniform Push { uint count, at, bad; };  // bad: bits of what goes to `at`

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  if (i == 0u) {
    head = 0x7FC00000u;  // the bits of a NaN, in a uint
    total = 1.0;
  }
  float value = i == at ? uintBitsToFloat(bad) : from[i];
#ifdef SENTINEL
  value = i + 1u == count ? uintBitsToFloat(0x7F800000u) : value;
#endif
  to[i] = Mixed(0xFFC00000u + i, vec3(1.0, value, 1.0), 2.0);
}
