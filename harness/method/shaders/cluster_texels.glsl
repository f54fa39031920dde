// The sorted texels of a half (first after its maps) and the moments of a block of them.
#ifndef VSGLBENCH_CLUSTER_TEXELS_GLSL
#define VSGLBENCH_CLUSTER_TEXELS_GLSL

#include "field_maps.glsl"
#include "field.glsl"
#include "cluster_sum.glsl"
layout(set = 0, binding = AFTER_MAPS, std430) readonly buffer Texels {
  uint texels[];
};  // y * width + x, by cluster

// Texel `i` of a row-major image. A vector division is slow where it is done lane by lane; the quotient in
// floats is at most one off.
ivec2 texel_position(uint i, uint width) {
  int y = int(float(i) / float(width));
  int x = int(i - uint(y) * width);
  if (x < 0) return ivec2(x + int(width), y - 1);
  return x >= int(width) ? ivec2(x - int(width), y + 1) : ivec2(x, y);
}

Moments sum_texels(Emitter emitter, uint first, uint end, uint stride) {
  Sum sum = empty_sum();
  for (uint i = first; i < end; i += stride) {
    Texel t;
    Moments m = empty_moments();
    if (load_texel(emitter, texel_position(texels[i], emitter.width), t)) m = leaf_moments(t);
    add(sum, m);
  }
  return total(sum);
}

#endif
