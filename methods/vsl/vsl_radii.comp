// The radius of each light: the distance of its k-th nearest neighbour among the lights that carry power,
// times a factor (density estimation as in photon mapping; Hašan et al. 2009). Where k lights stand on one
// texel the radius of its share stays; where there are fewer than k others, the farthest counts; where there
// is none, the share's.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer Lights { Vpl lights[]; };
layout(set = 0, binding = 1, std430) buffer Nearest {
  float nearest[];
};  // k squared distances a light, ascending
layout(push_constant, scalar) uniform Push {
  uint count;
  uint first, last;  // neighbours [first, last) in this dispatch
  uint neighbours;   // k
  float scale;
};
const float kNone = 3e38;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uint base = i * neighbours;
  if (first == 0u) {
    for (uint j = 0u; j < neighbours; ++j) nearest[base + j] = kNone;
  }
  vec3 position = lights[i].position;
  float worst = nearest[base + neighbours - 1u];
  for (uint n = first; n < last; ++n) {
    vec3 d = lights[n].position - position;
    float distance2 = dot(d, d);
    if (n == i || !(lights[n].power > 0.0) || distance2 >= worst) continue;
    // Insert: what is farther moves up.
    uint j = neighbours - 1u;
    for (; j > 0u && nearest[base + j - 1u] > distance2; --j) nearest[base + j] = nearest[base + j - 1u];
    nearest[base + j] = distance2;
    worst = nearest[base + neighbours - 1u];
  }
  if (last < count) return;
  float farthest = 0.0;
  for (uint j = 0u; j < neighbours; ++j) farthest = nearest[base + j] < kNone ? nearest[base + j] : farthest;
  if (farthest > 0.0) lights[i].radius = scale * sqrt(farthest);
}
