// What the tile variant's kernels share: a workgroup of TILE_THREADS sorts a tile of TILE_KEYS keys by one
// digit of at most 8 bits. Counts lie [bin][tile].
#define TILE_THREADS 128
#define TILE_ROUNDS 16  // keys of one invocation
#define TILE_KEYS (TILE_THREADS * TILE_ROUNDS)
#define MAX_BINS 256
#define MAX_SUBGROUPS 16  // a device with subgroups of fewer than 8 doesn't get this variant
layout(local_size_x = TILE_THREADS) in;
layout(push_constant, std430) uniform Push {
  uint count;  // keys
  uint tiles;
  uint shift;  // the digit is (key >> shift) & (2^bits - 1)
  uint bits;   // 1..8
};

uint digit(uint key) { return (key >> shift) & ((1u << bits) - 1u); }
