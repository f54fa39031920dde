// View-adaptive imperfect shadow maps (Ritschel et al. 2011): the points of each map are drawn from the
// scene's surface in proportion to what they may hide from the camera's pixels. One group of 256 invocations
// a light.
//
// The paper draws triangles from a distribution over all of them; here one over clusters of triangles that
// stays in shared memory, then by area within the cluster. The view is known to it by samples of the
// G-buffer, binned by their direction from the light.
#version 460
#include "types.h"
layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { uint count, map_size, per_map, cluster_count, width, height; };
#include "ism_surface.glsl"
layout(set = 0, binding = 6) uniform sampler2D position_map;

const uint kMostClusters = 4096u;  // SurfaceClusters::kMost
const uint kRun = kMostClusters / gl_WorkGroupSize.x;
const uint kBins = 16u;       // along an edge of the map of directions
const uint kSamples = 2048u;  // of the G-buffer
// What stands behind everything the samples show still gets some points: they may have missed a pixel.
const float kUnseen = 0.05;

shared float cumulative[kMostClusters];  // weight of the clusters up to and including each
shared float run_end[gl_WorkGroupSize.x];
shared uint farthest[kBins * kBins];  // distance of the farthest seen surface, float bits; 0: none

// The camera's surfaces as this light sees them.
void bin_view(vec3 origin, vec4 axis) {
  uint i = gl_LocalInvocationIndex;
  farthest[i] = 0u;
  barrier();
  for (uint j = i; j < kSamples; j += gl_WorkGroupSize.x) {
    vec2 u = sequence_point(j, uvec2(0u));
    vec4 seen = texelFetch(position_map, ivec2(u * vec2(width, height)), 0);
    vec3 d = seen.xyz - origin;
    float distance = length(d);
    uvec2 bin;
    if (seen.w > 0.0 && ism_texel(axis, d / max(distance, 1e-20), kBins, bin)) {
      atomicMax(farthest[bin.y * kBins + bin.x], floatBitsToUint(distance));
    }
  }
  barrier();
}

// Distance to the farthest seen surface about a bin: samples are few, so its neighbours count too.
float farthest_about(uvec2 bin) {
  uint bits = 0u;
  for (uint j = 0u; j < 9u; ++j) {
    ivec2 at = ivec2(bin) + ivec2(j % 3u, j / 3u) - 1;
    if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(kBins)))) {
      bits = max(bits, farthest[uint(at.y) * kBins + uint(at.x)]);
    }
  }
  return uintBitsToFloat(bits);
}

// Solid angle of a cluster from the light, if it may stand between the light and what the camera sees.
float weight_of(SurfaceCluster c, vec3 origin, vec4 axis) {
  vec3 d = c.centre - origin;
  if (axis.w == 0.0 && dot(d, axis.xyz) < -c.radius) return 0.0;
  float distance = length(d);
  vec3 w = d / max(distance, 1e-20);
  float near = max(distance, 0.5 * c.radius);
  float angle = c.area * cluster_cosine(c, w) / (near * near);
  uvec2 bin;
  ism_texel(axis, w, kBins, bin);
  bool hides = distance < 2.0 * c.radius || distance - c.radius <= farthest_about(bin);
  return min(angle, 6.2831853) * (hides ? 1.0 : kUnseen);
}

// `cumulative` from the weights in it.
void sum_weights() {
  uint i = gl_LocalInvocationIndex;
  float sum = 0.0;
  for (uint j = 0u; j < kRun; ++j) cumulative[kRun * i + j] = sum += cumulative[kRun * i + j];
  run_end[i] = sum;
  barrier();
  float before = 0.0;
  for (uint j = 0u; j < i; ++j) before += run_end[j];
  for (uint j = 0u; j < kRun; ++j) cumulative[kRun * i + j] += before;
  barrier();
}

uint cluster_at(float target) {
  uint low = 0u, high = cluster_count - 1u;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (cumulative[middle] <= target)
      low = middle + 1u;
    else
      high = middle;
  }
  return low;
}

void main() {
  uint k = gl_WorkGroupID.x, i = gl_LocalInvocationIndex;
  vec3 origin = frames[2u * k].xyz;
  vec4 axis = frames[2u * k + 1u];
  bin_view(origin, axis);
  for (uint j = i; j < kMostClusters; j += gl_WorkGroupSize.x) {
    cumulative[j] = j < cluster_count ? weight_of(clusters[j], origin, axis) : 0.0;
  }
  barrier();
  sum_weights();
  float total = cumulative[cluster_count - 1u];
  if (!(total > 0.0)) return;
  uint seed = random_hash(k);
  for (uint j = i; j < per_map; j += gl_WorkGroupSize.x) {
    // Stratified over the distribution; what is left of the number chooses within the cluster.
    float target = (float(j) + unit_float(random_hash(seed + j))) / float(per_map) * total;
    uint chosen = cluster_at(target);
    float before = chosen > 0u ? cumulative[chosen - 1u] : 0.0;
    float share = clamp((target - before) / (cumulative[chosen] - before), 0.0, 1.0);
    uvec3 t = triangles[triangle_at(clusters[chosen], share * clusters[chosen].area)];
    vec2 u = sequence_point(j, uvec2(seed, random_hash(seed)));
    vec3 a = positions[t.x], b = positions[t.y], c = positions[t.z];
    splat(k, point_in(a, b, c, u) - origin, cross(b - a, c - a));
  }
}
