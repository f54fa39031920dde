// my-method: one VSGL from each tile of the half, whose texels one workgroup sums.
#version 460
#include "types.h"
layout(local_size_x = 128) in;
#include "field_maps.glsl"
#include "field.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;  // N
  uint rows;   // of tiles
  vec2 shift;  // of the edges between tiles, 0 … 1 of a tile
  float blur;
};

shared Moments sums[gl_WorkGroupSize.x];

// Where part i of n begins, of `size` texels; the first part begins at 0 and the last ends at `size`.
uint edge(uint i, uint n, uint size, float shift) {
  if (i == 0u || i >= n) return i == 0u ? 0u : size;
  return uint(float(size) * ((float(i) - 1.0 + shift) / float(n)));
}

void main() {
  uint light = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;
  if (light >= count) return;  // the whole workgroup
  // 1. The light's tile: its row of tiles, and its place in the row.
  uint row = ((light + 1u) * rows - 1u) / count;
  uint first = row * count / rows, tiles = (row + 1u) * count / rows - first;
  uvec2 low =
      uvec2(edge(light - first, tiles, emitter.width, shift.x), edge(row, rows, emitter.height, shift.y));
  uvec2 high = uvec2(edge(light - first + 1u, tiles, emitter.width, shift.x),
                     edge(row + 1u, rows, emitter.height, shift.y));
  uvec2 size = high - low;
  // 2. Each invocation sums every 128th texel of it.
  Moments sum = empty_moments();
  for (uint i = lane; i < size.x * size.y; i += gl_WorkGroupSize.x) {
    Texel t;
    if (load_texel(emitter, ivec2(low + uvec2(i % size.x, i / size.x)), t))
      sum = merge_two(sum, leaf_moments(t));
  }
  // 3. Pairs of sums, until one is left.
  sums[lane] = sum;
  for (uint pairs = gl_WorkGroupSize.x / 2u; pairs > 0u; pairs /= 2u) {
    barrier();
    if (lane < pairs) sums[lane] = merge_two(sums[lane], sums[lane + pairs]);
  }
  // 4. The light.
  if (lane > 0u) return;
  sums[0].variance *= blur;
  lights[light] = make_vsgl(sums[0], 1.0, -1.0);
}
