// One step of Lloyd's: each centre to the mean of its texels, weighted with the PDF that the centres were
// drawn by. A cluster whose texels the PDF leaves out keeps its centre.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D position_map;
layout(set = 0, binding = 1, std430) readonly buffer Ids { uint ids[]; };        // ascending
layout(set = 0, binding = 2, std430) readonly buffer Texels { uint texels[]; };  // of the same order
layout(set = 0, binding = 3, std430) readonly buffer Pdf { float pdf[]; };
layout(set = 0, binding = 4, std430) buffer Centres { vec4 centres[]; };
layout(set = 0, binding = 5, std430) buffer Sums { vec4 sums[]; };  // Σ p (y - centre), Σ p
layout(push_constant, std430) uniform Push {
  uint width, texel_count;
  uint count;                // N
  uint round, rounds, most;  // this dispatch goes through texels round × most and on of each cluster
};

// Index of the first texel of cluster `id` or above.
uint first_of(uint id) {
  uint lo = 0u, hi = texel_count;
  while (lo < hi) {
    uint middle = (lo + hi) / 2u;
    if (ids[middle] < id) {
      lo = middle + 1u;
    } else {
      hi = middle;
    }
  }
  return lo;
}

vec3 place(uint texel) {
  ivec2 at = ivec2(texel % width, texel / width);
#if DIMENSIONS == 2
  return vec3(vec2(at) + 0.5, 0.0);
#else
  return texelFetch(position_map, at, 0).xyz;
#endif
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count || !(centres[i].w > 0.0)) return;
  // Offsets from the old centre, so that far from the origin nothing rounds away.
  vec3 base = centres[i].xyz;
  vec4 sum = round > 0u ? sums[i] : vec4(0.0);
  uint first = first_of(i) + round * most, end = min(first_of(i + 1u), first + most);
  for (uint k = first; k < end; ++k) {
    float p = pdf[texels[k]];
    sum += p * vec4(place(texels[k]) - base, 1.0);
  }
  sums[i] = sum;
  if (round + 1u == rounds && sum.w > 0.0) centres[i].xyz = base + sum.xyz / sum.w;
}
