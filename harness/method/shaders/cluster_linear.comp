// One thread sums one cluster [MFIS16 App. D; Prutkin et al. 2012], up to `most` texels of it a dispatch.
#version 460
#include "types.h"
#include "cluster_texels.glsl"
layout(local_size_x = GROUP) in;
layout(set = 0, binding = AFTER_MAPS + 1, std430) readonly buffer Starts {
  uint starts[];
};  // [cluster 0..N]
layout(set = 0, binding = AFTER_MAPS + 2, scalar) buffer Unfinished { Moments unfinished[]; };  // [cluster]
layout(set = 0, binding = AFTER_MAPS + 3, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint clusters;  // N
  uint most;      // a multiple of BLOCK²
  uint round;     // the dispatch's number
};

void main() {
  uint cluster = INVOCATION;
  if (cluster >= clusters) return;
  // 1. The texels of this round; none left: the light was made before.
  uint first = starts[cluster], last = starts[cluster + 1u];
  if (first == last) {
    if (round == 0u) lights[cluster] = no_light();
    return;
  }
  if ((last - first - 1u) / most < round) return;
  uint at = first + round * most, end = at + min(most, last - at);
  // 2. Blocks of texels, blocks of blocks, and those.
  Sum sum = empty_sum();
  if (round > 0u) add(sum, unfinished[cluster]);
  while (at < end) {
    uint middle_end = at + min(BLOCK * BLOCK, end - at);
    Sum middle = empty_sum();
    for (; at < middle_end; at += BLOCK) {
      add(middle, sum_texels(emitter, at, min(at + BLOCK, middle_end), 1u));
    }
    at = middle_end;
    add(sum, total(middle));
  }
  // 3. The light, or what the next round goes on from.
  if (end == last) {
    lights[cluster] = make_vsgl(total(sum), 1.0, -1.0);
  } else {
    unfinished[cluster] = total(sum);
  }
}
