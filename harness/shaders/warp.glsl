// Stratified sampling of a PDF pyramid: Fibonacci lattice, hierarchical warping (Clarberg et al. 2005).
// The including file declares `PDF(i)`, the value of pyramid texel i; any positive multiple of a PDF will do.
#ifndef VSGLBENCH_WARP_GLSL
#define VSGLBENCH_WARP_GLSL

#include "pyramid.glsl"

// Point i of N: (i/N, frac(i/φ)) + shift, modulo 1, in 32-bit fixed point so that host and device agree to
// the bit. `step` = floor(2^32/N).
uvec2 lattice_point(uint i, uint step, uvec2 shift) { return uvec2(i * step, i * 0x9E3779B9u) + shift; }
// In (0,1), exact in single precision. Never 0: at 0 the first part would be chosen however small it is, and
// stand for all the power that its p says it lacks.
vec2 unit_interval(uvec2 fixed_point) { return (vec2(fixed_point >> 9) + 0.5) * (1.0 / 8388608.0); }

// Splits u between two sums; returns which, and rescales u to [0,1). A part of zero is never chosen.
bool choose(float first, float second, inout float u) {
  float total = first + second;
  float p = total > 0.0 ? first / total : 1.0;
  bool second_chosen = second > 0.0 && (u >= p || first <= 0.0);
  u = second_chosen ? (u - p) / max(1.0 - p, 1e-30) : u / max(p, 1e-30);
  u = clamp(u, 0.0, 0.99999994);
  return second_chosen;
}

float pdf_sum(uvec2 base, uint level, uint offset, uvec2 t) {
  uvec2 size = level_size(base, level);
  if (t.x >= size.x || t.y >= size.y) return 0.0;
  return PDF(offset + t.y * size.x + t.x) * covered(base, level, t);
}

// The base texel that u warps to. The PDF must not be zero everywhere.
uvec2 warp(uvec2 base, vec2 u) {
  uvec2 t = uvec2(0u);
  for (uint above = top_level(base); above > 0u; --above) {
    uint level = above - 1u;
    uint offset = level_offset(base, level);
    t *= 2u;
    float s00 = pdf_sum(base, level, offset, t);
    float s10 = pdf_sum(base, level, offset, t + uvec2(1u, 0u));
    float s01 = pdf_sum(base, level, offset, t + uvec2(0u, 1u));
    float s11 = pdf_sum(base, level, offset, t + uvec2(1u, 1u));
    // Rows first, then the column within the row.
    bool lower = choose(s00 + s10, s01 + s11, u.y);
    bool right = lower ? choose(s01, s11, u.x) : choose(s00, s10, u.x);
    t += uvec2(right ? 1u : 0u, lower ? 1u : 0u);
  }
  return t;
}

#endif
