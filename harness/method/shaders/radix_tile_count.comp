// Tile variant, step 1: each tile's histogram. Integer sums: the order of the atomics doesn't show.
#version 460
#include "radix_tile.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Counts { uint counts[]; };
shared uint histogram[MAX_BINS];

void main() {
  uint thread = gl_LocalInvocationID.x, tile = gl_WorkGroupID.x;
  for (uint bin = thread; bin < MAX_BINS; bin += TILE_THREADS) histogram[bin] = 0u;
  barrier();
  for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint i = tile * TILE_KEYS + round * TILE_THREADS + thread;
    if (i < count) atomicAdd(histogram[digit(keys[i])], 1u);
  }
  barrier();
  for (uint bin = thread; bin < 1u << bits; bin += TILE_THREADS) counts[bin * tiles + tile] = histogram[bin];
}
