// Weighs every texel. `at` gets a weight that is no number.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) writeonly buffer Weights { float weights[]; };
layout(push_constant) uniform Push { uint count, at; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) weights[i] = uintBitsToFloat(i == at ? 0x7fc00000u : 0x3f800000u);
}
