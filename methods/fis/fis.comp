// Filtered importance sampling with the PDF at the footprint's centre (Křivánek and Colbert 2008; VSGLs:
// Tokuyoshi 2015).
#version 460
#include "types.h"
#include "filtered_sampling.glsl"

// 4^l/M = min(K/(N p(x)), 1) [MFIS16 Eq. 1].
float footprint_level(Centre c) {
  float area = min(footprint_size / (float(count) * c.p), 1.0);
  return max(0.5 * log2(area * texel_count()), 0.0);
}

// f̄/max(N p(x), 1) [MFIS16 Eq. 4].
float footprint_share(Centre c, float level) { return 1.0 / max(float(count) * c.p, 1.0); }
