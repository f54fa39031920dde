// What a seed decides: shifts of the lattice, and random words.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace vsglbench {

// SplitMix64: one well-mixed word a seed.
inline uint64_t mix(uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

// A hash of the seed: a random shift, of seed 0 as of all others.
inline glm::uvec2 lattice_shift(uint32_t seed) {
  const uint64_t word = mix(seed);
  return {static_cast<uint32_t>(word), static_cast<uint32_t>(word >> 32)};
}

// The shift of one iteration: from the seed's own along Roberts' R2 sequence, so that the iterations'
// lattices fill each other's gaps.
inline glm::uvec2 iteration_shift(uint32_t seed, uint32_t iteration) {
  return lattice_shift(seed) + iteration * glm::uvec2(3242174889u, 2447445414u);
}

// What the lattice does from one frame of an animation to the next: it stays, or is shifted anew in each.
enum class Lattice { fixed, shifted };

// The seed of a frame of an animation that is rendered with `seed`: frame 0 has its own.
inline uint32_t seed_in_frame(uint32_t seed, uint32_t frame, Lattice lattice) {
  if (lattice == Lattice::fixed || frame == 0) return seed;
  return static_cast<uint32_t>(mix(mix(seed) ^ frame));
}

}  // namespace vsglbench
