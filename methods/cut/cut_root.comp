// Step 2, first, by one workgroup: the tree's space, the samples in it, and the root. A sample without a
// surface, which an honest PDF doesn't draw, becomes a copy of the first that has one.
#version 460
layout(set = 0, binding = 0, std430) buffer Samples { float samples[]; };
#define SAMPLES samples
#include "cut_samples.glsl"
layout(set = 0, binding = 1, scalar) writeonly buffer Spaces { Space space; };
layout(set = 0, binding = 2, scalar) writeonly buffer Tasks { Task tasks[]; };
layout(push_constant, std430) uniform Push {
  uint count, lights;
  float direction_length;
};
shared uint firsts[LANES];

bool has_surface(vec3 direction) { return dot(direction, direction) > 0.0; }

// The first sample that has a surface; `count` if none has.
uint first_surface() {
  uint lane = gl_LocalInvocationID.x, found = count;
  for (uint i = lane; i < count && found == count; i += LANES) {
    if (has_surface(sample_direction(i))) found = i;
  }
  firsts[lane] = found;
  barrier();
  for (uint k = 0u; k < LANES; ++k) found = min(found, firsts[k]);
  barrier();
  return found;
}

void main() {
  uint lane = gl_LocalInvocationID.x, stand_in = first_surface();
  bool valid = stand_in < count;
  vec3 base = valid ? sample_position(stand_in) : vec3(0.0);
  vec3 base_direction = valid ? sample_direction(stand_in) : vec3(0.0);
  // 1. Moments of the positions, as offsets from a sample, so that far from the origin nothing rounds away.
  mat4 part = mat4(0.0);
  for (uint i = lane; i < count; i += LANES) {
    vec3 d = has_surface(sample_direction(i)) ? sample_position(i) - base : vec3(0.0);
    part[0] += vec4(d, dot(d, d));
  }
  vec4 moments = reduce(part)[0] / float(count);
  float variance = moments.w - dot(moments.xyz, moments.xyz);
  vec3 origin = base + moments.xyz;
  float scale = variance > 1e-20 ? inversesqrt(variance) : 0.0;
  // 2. The samples in that space.
  for (uint i = lane; i < count; i += LANES) {
    vec3 position = sample_position(i), direction = sample_direction(i);
    bool surface = has_surface(direction);
    position = ((surface ? position : base) - origin) * scale;
    direction = direction_length * (surface ? direction : base_direction);
    STORE_POINT(samples, i, position, direction);
  }
  // 3. The root.
  if (lane != 0u) return;
  space = Space(origin, scale, valid ? 1u : 0u);
  if (lights > 1u) tasks[1] = Task(0u, 0u, count, 0u, 0u, lights);
}
