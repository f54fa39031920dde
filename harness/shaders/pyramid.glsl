// Pyramids in storage buffers: level l has ceil(w/2^l) × ceil(h/2^l) texels, each the mean of the base
// texels it covers; levels follow one another. Coordinates are in base texels on every level, so sizes that
// are no powers of two keep their place (unlike a graphics API's floor-halving mip chain).
#ifndef VSGLBENCH_PYRAMID_GLSL
#define VSGLBENCH_PYRAMID_GLSL

uvec2 level_size(uvec2 base, uint level) { return (base + (1u << level) - 1u) >> level; }

uint top_level(uvec2 base) {
  uint n = max(base.x, base.y), level = 0u;
  while ((1u << level) < n) ++level;
  return level;
}

uint level_offset(uvec2 base, uint level) {
  uint offset = 0u;
  for (uint l = 0u; l < level; ++l) {
    uvec2 s = level_size(base, l);
    offset += s.x * s.y;
  }
  return offset;
}

// Base texels that texel `t` of `level` covers; 0 outside the level.
float covered(uvec2 base, uint level, uvec2 t) {
  uvec2 from = min(t << level, base), to = min((t + 1u) << level, base);
  return float(to.x - from.x) * float(to.y - from.y);
}

// Weight of texel `upper` against its lower neighbour at `f` of the way between their centres, on one axis.
// The last texel of a level may cover only a part c of a block. Summed over all base texels' centres, a
// texel's weight must be what it covers, or the mean over positions is not the mean over texels. Linear
// weights give it that for c >= 1/2; below they would give (1/2 + c)²/2, so the last texel's are scaled by c
// over that.
float upper_weight(uint base, uint level, uint upper, float f) {
  float c = float(min((upper + 1u) << level, base) - (upper << level)) / float(1u << level);
  return c < 0.5 ? f * 2.0 * c / ((0.5 + c) * (0.5 + c)) : f;
}

// The four texels and weights of bilinear filtering at `position` (in base texels), clamped to the edge.
struct Taps {
  uint index[4];
  float weight[4];
};
Taps bilinear_taps(uvec2 base, uint level, vec2 position) {
  uvec2 size = level_size(base, level);
  vec2 c = clamp(position / float(1u << level) - 0.5, vec2(0.0), vec2(size - 1u));
  uvec2 lo = uvec2(c);
  uvec2 hi = min(lo + 1u, size - 1u);
  vec2 f = vec2(upper_weight(base.x, level, hi.x, c.x - float(lo.x)),
                upper_weight(base.y, level, hi.y, c.y - float(lo.y)));
  uint offset = level_offset(base, level);
  Taps taps;
  taps.index[0] = offset + lo.y * size.x + lo.x;
  taps.index[1] = offset + lo.y * size.x + hi.x;
  taps.index[2] = offset + hi.y * size.x + lo.x;
  taps.index[3] = offset + hi.y * size.x + hi.x;
  taps.weight[0] = (1.0 - f.x) * (1.0 - f.y);
  taps.weight[1] = f.x * (1.0 - f.y);
  taps.weight[2] = (1.0 - f.x) * f.y;
  taps.weight[3] = f.x * f.y;
  return taps;
}

#endif
