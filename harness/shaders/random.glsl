// Random words and numbers without state between invocations.
#ifndef VSGLBENCH_RANDOM_GLSL
#define VSGLBENCH_RANDOM_GLSL

// PCG's output permutation over a linear congruential step (Jarzynski and Olano 2020).
uint random_hash(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}
uint random_hash(uvec2 x) { return random_hash(x.x + random_hash(x.y)); }

// In [0,1).
float unit_float(uint word) { return float(word >> 8u) * 5.9604645e-8; }

// Point j of a two-dimensional Kronecker sequence (Roberts' R2), shifted by the words of `seed`: well spread
// for every number of points.
vec2 sequence_point(uint j, uvec2 seed) {
  uvec2 word = seed + j * uvec2(3242174889u, 2447445414u);  // 2^32/ρ, 2^32/ρ², ρ³ = ρ+1
  return vec2(unit_float(word.x), unit_float(word.y));
}

#endif
