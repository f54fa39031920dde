// Tile variant, step 4: ranks within a tile by matching digits inside subgroups (ballots), then the move.
// Each subgroup takes a contiguous part of the tile, so ranks follow the keys' order and the sort is stable.
#version 460
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "radix_tile.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 2, std430) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 4, std430) writeonly buffer SortedKeys { uint sorted_keys[]; };
layout(set = 0, binding = 5, std430) writeonly buffer SortedValues { uint sorted_values[]; };

#define MAX_SUBGROUPS (TILE_THREADS / 4)  // no device has subgroups of fewer than 4
#define BIN_WORDS (MAX_BINS / 2)
// Keys of a digit that a subgroup has seen; later, those of the subgroups before it. 16 bits each, two a
// word.
shared uint seen[MAX_SUBGROUPS * BIN_WORDS];
shared uint first[MAX_BINS];  // where the tile's first key of a digit goes

#ifdef INDEX_PAYLOAD  // values are not read: the payload is the key's index
#define VALUE(i) (i)
#else
#define VALUE(i) values[i]
#endif

uint seen_word(uint d) { return gl_SubgroupID * BIN_WORDS + d / 2u; }
uint seen_shift(uint d) { return 16u * (d & 1u); }
uint seen_of(uint d) { return (seen[seen_word(d)] >> seen_shift(d)) & 0xFFFFu; }
uint bits_in(uvec4 mask) {
  ivec4 n = bitCount(mask);
  return uint(n.x + n.y + n.z + n.w);
}

// Invocations of the subgroup that hold the digit d, of those with `valid`.
uvec4 matching(uint d, bool valid) {
  uvec4 same = subgroupBallot(valid);
  for (uint bit = 0u; bit < bits; ++bit) {
    bool set = (d >> bit & 1u) != 0u;
    uvec4 vote = subgroupBallot(set);
    same &= set ? vote : ~vote;
  }
  return same;
}

void main() {
  uint thread = gl_LocalInvocationID.x, tile = gl_WorkGroupID.x;
  for (uint i = thread; i < MAX_SUBGROUPS * BIN_WORDS; i += TILE_THREADS) seen[i] = 0u;
  for (uint bin = thread; bin < 1u << bits; bin += TILE_THREADS) {
    first[bin] = starts[bin] + counts[bin * tiles + tile];
  }
  barrier();
  // 1. Rank of every key among its subgroup's keys of the same digit. Subgroups are full: every subgroup size
  // divides TILE_THREADS.
  uint from = tile * TILE_KEYS + gl_SubgroupID * gl_SubgroupSize * TILE_ROUNDS + gl_SubgroupInvocationID;
  uint rank[TILE_ROUNDS];
  for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint i = from + round * gl_SubgroupSize;
    bool valid = i < count;
    uint d = valid ? digit(keys[i]) : 0u;
    uvec4 same = matching(d, valid);
    uint before = bits_in(same & gl_SubgroupLtMask);
    rank[round] = seen_of(d) + before;
    subgroupBarrier();
    // One invocation of each digit counts for all. Atomic, because its word also holds a neighbour's count.
    if (valid && before == 0u) atomicAdd(seen[seen_word(d)], bits_in(same) << seen_shift(d));
    subgroupBarrier();
  }
  barrier();
  // 2. Keys of the subgroups before, by digit; a sum of at most TILE_KEYS fits into 16 bits.
  for (uint word = thread; word < BIN_WORDS; word += TILE_THREADS) {
    uint sum = 0u;
    for (uint s = 0u; s < gl_NumSubgroups; ++s) {
      uint n = seen[s * BIN_WORDS + word];
      seen[s * BIN_WORDS + word] = sum;
      sum += n;
    }
  }
  barrier();
  // 3. Move.
  for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint i = from + round * gl_SubgroupSize;
    if (i >= count) break;
    uint key = keys[i], d = digit(key);
    uint to = first[d] + seen_of(d) + rank[round];
    sorted_keys[to] = key;
    sorted_values[to] = VALUE(i);
  }
}
