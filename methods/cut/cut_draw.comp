// Step 1: samples of the PDF, drawn as fis and mfis draw their centres. One without a surface is marked by a
// direction of zero length.
#version 460
#include "cut.glsl"
layout(local_size_x = 64) in;
#include "cut_texel.glsl"
layout(set = 0, binding = AFTER_MAPS, std430) readonly buffer Pdf { float pdf[]; };
layout(set = 0, binding = AFTER_MAPS + 1, std430) writeonly buffer Samples { float samples[]; };
#define PDF(i) pdf[i]
#include "warp.glsl"
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;  // samples
  uint step;   // floor(2^32/count)
  uvec2 shift;
  float glossy;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  uvec2 base = uvec2(emitter.width, emitter.height);
  vec3 position = vec3(0.0), direction = vec3(0.0);
  if (PDF(level_offset(base, top_level(base))) > 0.0) {
    ivec2 texel = ivec2(warp(base, unit_interval(lattice_point(i, step, shift))));
    if (!load_point(emitter, texel, glossy, position, direction)) direction = vec3(0.0);
  }
  STORE_POINT(samples, i, position, direction);
}
