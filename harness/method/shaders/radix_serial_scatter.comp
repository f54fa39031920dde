// Serial variant, step 5: every invocation moves the pairs of its run, in order, to where its counters point.
#version 460
#include "radix_serial.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 0, std430) readonly buffer KeyQuads { uvec4 key_quads[]; };
layout(set = 0, binding = 1, std430) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 1, std430) readonly buffer ValueQuads { uvec4 value_quads[]; };
layout(set = 0, binding = 2, std430) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3, std430) writeonly buffer SortedKeys { uint sorted_keys[]; };
layout(set = 0, binding = 4, std430) writeonly buffer SortedValues { uint sorted_values[]; };

#ifdef INDEX_PAYLOAD  // values are not read: the payload is the key's index
#define VALUE(i) (i)
#define VALUE_QUAD(i) ((i) + uvec4(0u, 1u, 2u, 3u))
#else
#define VALUE(i) values[i]
#define VALUE_QUAD(i) value_quads[(i) / 4u]
#endif

void put(uint counter, uint key, uint value) {
  uint to = counters[counter];
  counters[counter] = to + 1u;
  sorted_keys[to] = key;
  sorted_values[to] = value;
}

void main() {
  uvec2 run = key_run();
  uint whole = run.y & ~3u;
  for (uint i = run.x; i < whole; i += 4u) {
    uvec4 key = key_quads[i / 4u], value = VALUE_QUAD(i);
    uvec4 c = counter_index(digit(key));
    put(c.x, key.x, value.x);
    put(c.y, key.y, value.y);
    put(c.z, key.z, value.z);
    put(c.w, key.w, value.w);
  }
  for (uint i = max(run.x, whole); i < run.y; ++i) {
    put(counter_index(digit(uvec4(keys[i]))).x, keys[i], VALUE(i));
  }
}
