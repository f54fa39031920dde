// The footprints of `mfis` round centres drawn by Metropolis-Hastings (Barák et al. 2013; [MFIS16] §6, Fig.
// 8).
//
// A chain that starts fresh in every frame runs from the point that `mfis` would take, with the same random
// numbers: a centre depends on the PDF alone, and a PDF that changes a little changes few decisions to
// accept, so that most centres stay exactly where they were. With CARRIED a chain goes on where that of the
// frame before ended, as those of Barák et al. do.
#version 460
#include "types.h"
#define OWN_CENTRES
#include "filtered_sampling.glsl"
#include "equal_probability.glsl"
#include "random.glsl"

const uint kSteps = STEPS;

#ifdef CARRIED
layout(set = 0, binding = AFTER_MOMENTS + 2, scalar) buffer Chains {
  vec3
      chain_ends[];  // xy: where the chain of light i was when the frame before ended; z: 1, or 0 of no frame
};
#endif

uint texel_index(vec2 u) {
  uvec2 texel = min(uvec2(u * vec2(base_size())), base_size() - 1u);
  return texel.y * width + texel.x;
}

// Half of the proposals lie anywhere; half near the last point, at a distance of 2^-8 to 2^-3 of the image,
// each octave as likely. Both are symmetric, so p(y)/p(x) decides.
vec2 propose(vec2 x, uvec2 word) {
  vec2 u = vec2(unit_float(word.x), unit_float(word.y));
  uint choice = random_hash(word.x ^ word.y);
  if ((choice & 1u) == 0u) return u;
  float angle = 2.0 * PI * u.x, distance = exp2(-8.0 + 5.0 * u.y);
  return fract(x + distance * vec2(cos(angle), sin(angle)));
}

// A start that is distributed as p is leaves nothing to warm up, however narrow a peak is.
vec2 fresh_start(uint i) {
  return (vec2(warp(base_size(), unit_interval(lattice_point(i, step, shift)))) + 0.5) / vec2(base_size());
}

vec2 start(uint i) {
#ifdef CARRIED
  // From where p is 0 a chain would wander on, until it happens upon some.
  vec3 end = chain_ends[i];
  if (end.z == 1.0 && PDF(texel_index(end.xy)) > 0.0) return end.xy;
#endif
  return fresh_start(i);
}

uvec2 choose_texel(uint i) {
  vec2 x = start(i);
  uint chain = random_hash(i ^ random_hash(shift));
#ifdef CARRIED
  // Every frame has random numbers of its own: a point that was found by some is no draw of p for the same
  // ones.
  if (frame > 0u) chain = random_hash(chain ^ random_hash(frame));
#endif
  for (uint t = 0u; t < kSteps; ++t) {
    uint word = random_hash(chain + 2u * t);
    vec2 y = propose(x, uvec2(word, random_hash(word)));
    // u p(x) <= p(y), so that a point where p is 0 is always left.
    float u = unit_float(random_hash(chain + 2u * t + 1u));
    if (u * PDF(texel_index(x)) <= PDF(texel_index(y))) x = y;
  }
#ifdef CARRIED
  chain_ends[i] = vec3(x, 1.0);
#endif
  return min(uvec2(x * vec2(base_size())), base_size() - 1u);
}
