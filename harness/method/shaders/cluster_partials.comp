// Segmented sum, step 4, once a level: each invocation sums one piece of a cluster's partial sums.
#version 460
#include "types.h"
#include "cluster_sum.glsl"
layout(local_size_x = GROUP) in;
#define STARTS_BINDING 0
#include "cluster_piece.glsl"
layout(set = 0, binding = 1, scalar) readonly buffer Below { Moments below[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Partials { Moments partials[]; };
layout(push_constant, std430) uniform Push { uint clusters, bound, level; };

void main() {
  uint piece = INVOCATION;
  if (piece >= bound) return;
  Items items = piece_items(piece, level, clusters);
  if (items.first >= items.end) return;
  Sum sum = empty_sum();
  for (uint i = items.first; i < items.end; i += items.stride) add(sum, below[i]);
  partials[piece] = total(sum);
}
