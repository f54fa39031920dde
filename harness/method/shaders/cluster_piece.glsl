// Which items make up a piece.
#ifndef VSGLBENCH_CLUSTER_PIECE_GLSL
#define VSGLBENCH_CLUSTER_PIECE_GLSL

#include "cluster_sum.glsl"
layout(set = 0, binding = STARTS_BINDING, std430) readonly buffer Starts { uint starts[]; };  // [level][0..N]
#define UPPER(i) starts[upper + (i) + 1u]

// Invocations whose items are interleaved, so that neighbours read neighbouring memory.
#define ROW 8u

struct Items {
  uint first, end, stride;  // items of the level below: first, first + stride, ... below end
};

// The items of piece `piece` of `level` (1 is the lowest); none where there is no such piece. A cluster of n
// items and P pieces is cut into rows of ROW pieces; a row's items are dealt to its pieces in turn, at most
// ceil(n/P) each.
Items piece_items(uint piece, uint level, uint clusters) {
  uint upper = level * (clusters + 1u), lower = upper - (clusters + 1u);
  if (piece >= starts[upper + clusters]) return Items(0u, 0u, 1u);
  // The cluster: the first whose pieces end after this one.
  LOWER_BOUND(cluster, clusters, piece + 1u, UPPER)
  uint pieces = starts[upper + cluster + 1u] - starts[upper + cluster];
  uint first = starts[lower + cluster], last = starts[lower + cluster + 1u];
  uint length = (last - first + pieces - 1u) / pieces;
  // The row, and the place in it. Its end may pass the cluster's; no piece is left without items.
  uint place = piece - starts[upper + cluster];
  uint row = place - place % ROW, width = min(ROW, pieces - row);
  uint from = first + row * length;
  return Items(from + (place - row), min(from + width * length, last), width);
}

#endif
