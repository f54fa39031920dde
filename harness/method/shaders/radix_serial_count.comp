// Serial variant, step 1: every invocation counts the digits of its own run of keys, in counters that no
// other touches.
#version 460
#include "radix_serial.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 0, std430) readonly buffer KeyQuads { uvec4 key_quads[]; };
layout(set = 0, binding = 1, std430) buffer Counters { uint counters[]; };  // all 0 at the start

void main() {
  uvec2 run = key_run();
  uint whole = run.y & ~3u;
  for (uint i = run.x; i < whole; i += 4u) {
    uvec4 c = counter_index(digit(key_quads[i / 4u]));
    ++counters[c.x];
    ++counters[c.y];
    ++counters[c.z];
    ++counters[c.w];
  }
  for (uint i = max(run.x, whole); i < run.y; ++i) ++counters[counter_index(digit(uvec4(keys[i]))).x];
}
