// Segmented sum, step 3: each invocation sums one piece of a cluster's texels.
#version 460
#include "types.h"
#include "cluster_texels.glsl"
layout(local_size_x = GROUP) in;
#define STARTS_BINDING (AFTER_MAPS + 1)
#include "cluster_piece.glsl"
layout(set = 0, binding = AFTER_MAPS + 2, scalar) writeonly buffer Partials { Moments partials[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint clusters;  // N
  uint bound;     // pieces at most
};

void main() {
  uint piece = INVOCATION;
  if (piece >= bound) return;
  Items items = piece_items(piece, 1u, clusters);
  if (items.first < items.end) partials[piece] = sum_texels(emitter, items.first, items.end, items.stride);
}
