// Tile variant, step 4: ranks within a tile by matching digits inside subgroups (ballots), then the move by
// way of shared memory, in which a tile's pairs lie in their order: neighbours of a digit go to neighbouring
// places in one write. Each subgroup takes a contiguous part of the tile, so ranks follow the keys' order and
// the sort is stable.
#version 460
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_EXT_control_flow_attributes : require
#include "radix_tile.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, std430) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 2, std430) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 3, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 4, std430) writeonly buffer SortedKeys { uint sorted_keys[]; };
layout(set = 0, binding = 5, std430) writeonly buffer SortedValues { uint sorted_values[]; };

// One word, two bins, an invocation. Two counts a word, 16 bits each: a tile has fewer keys than they hold.
#define BIN_WORDS (MAX_BINS / 2)
#if BIN_WORDS != TILE_THREADS || TILE_KEYS != MAX_SUBGROUPS * BIN_WORDS
#error an invocation takes a word of two bins, and a tile's keys take the place of its counts
#endif
// Keys of a digit that a subgroup has seen; then, where in the tile its first of a digit goes; at last, the
// tile's keys in their new order, and then their values.
shared uint words[TILE_KEYS];
shared uint
    first[MAX_BINS];  // by how much a digit's keys move, from their places in the sorted tile (modulo 2^32)
shared uint subgroup_sums[MAX_SUBGROUPS];

#ifdef INDEX_PAYLOAD  // values are not read: the payload is the key's index
#define VALUE(i) (i)
#else
#define VALUE(i) values[i]
#endif

uint count_word(uint d) { return gl_SubgroupID * BIN_WORDS + d / 2u; }
uint count_shift(uint d) { return 16u * (d & 1u); }
uint count_of(uint d) { return (words[count_word(d)] >> count_shift(d)) & 0xFFFFu; }
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
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) words[round * TILE_THREADS + thread] = 0u;
  barrier();
  // 1. Rank of every key among its subgroup's keys of the same digit. Subgroups are full: every subgroup size
  // divides TILE_THREADS.
  uint from = tile * TILE_KEYS + gl_SubgroupID * gl_SubgroupSize * TILE_ROUNDS + gl_SubgroupInvocationID;
  uint key[TILE_ROUNDS], place[TILE_ROUNDS];
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint i = from + round * gl_SubgroupSize;
    bool valid = i < count;
    key[round] = valid ? keys[i] : 0u;
    uint d = digit(key[round]);
    uvec4 same = matching(d, valid);
    uint before = bits_in(same & gl_SubgroupLtMask);
    place[round] = count_of(d) + before;
    subgroupBarrier();
    // One invocation of each digit counts for all. Atomic, because its word also holds a neighbour's count.
    if (valid && before == 0u) atomicAdd(words[count_word(d)], bits_in(same) << count_shift(d));
    subgroupBarrier();
  }
  barrier();
  // 2. Keys of the subgroups before, by digit.
  // Not gl_LocalInvocationID: bins must follow one another in the order of the subgroup scan.
  uint lane = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID, pair = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) {
    uint n = words[s * BIN_WORDS + lane];
    words[s * BIN_WORDS + lane] = pair;
    pair += n;
  }
  // 3. Keys of smaller digits: a scan over the bins, two an invocation.
  uint low = pair & 0xFFFFu, both = low + (pair >> 16);
  uint below = subgroupExclusiveAdd(both), sum = subgroupAdd(both);
  if (subgroupElect()) subgroup_sums[gl_SubgroupID] = sum;
  barrier();
  for (uint s = 0u; s < gl_SubgroupID; ++s) below += subgroup_sums[s];
  for (uint s = 0u; s < gl_NumSubgroups; ++s) words[s * BIN_WORDS + lane] += below | (below + low) << 16;
  [[unroll]] for (uint k = 0u; k < 2u; ++k) {
    uint bin = 2u * lane + k;
    if (bin < 1u << bits)
      first[bin] = starts[bin] + counts[bin * tiles + tile] - (k == 0u ? below : below + low);
  }
  barrier();
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) place[round] += count_of(digit(key[round]));
  barrier();
  // 4. Keys into their order in the tile, and from there to their places.
  uint there = min(count - tile * TILE_KEYS, TILE_KEYS), to[TILE_ROUNDS];
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) if (from + round * gl_SubgroupSize < count)
      words[place[round]] = key[round];
  barrier();
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint at = round * TILE_THREADS + thread, moved = words[at];
    to[round] = first[digit(moved)] + at;
    if (at < there) sorted_keys[to[round]] = moved;
  }
  barrier();
  // 5. Values likewise.
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint i = from + round * gl_SubgroupSize;
    if (i < count) words[place[round]] = VALUE(i);
  }
  barrier();
  [[unroll]] for (uint round = 0u; round < TILE_ROUNDS; ++round) {
    uint at = round * TILE_THREADS + thread;
    if (at < there) sorted_values[to[round]] = words[at];
  }
}
