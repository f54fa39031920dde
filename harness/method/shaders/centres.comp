// Cluster centres: the texels that a stratified point set, warped by the PDF, chooses [MFIS16 App. D],
// exactly as fis and mfis choose theirs. A PDF that is zero everywhere gives N centres that are none (w = 0).
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D position_map;  // xyz, w > 0 where there is a surface
layout(set = 0, binding = 1, std430) readonly buffer Pdf { float pdf[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Centres { vec4 centres[]; };
#define PDF(i) pdf[i]
#include "warp.glsl"
layout(push_constant, scalar) uniform Push {
  uint width, height;
  uint count;  // N
  uint step;   // floor(2^32/N)
  uvec2 shift;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uvec2 base = uvec2(width, height);
  float mean = PDF(level_offset(base, top_level(base)));
  vec4 centre = vec4(0.0);
  if (mean > 0.0) {
    uvec2 texel = warp(base, unit_interval(lattice_point(i, step, shift)));
#if DIMENSIONS == 2
    centre = vec4(vec2(texel) + 0.5, 0.0, 1.0);
#else
    centre = texelFetch(position_map, ivec2(texel), 0);
#endif
  }
  centres[i] = centre;
}
