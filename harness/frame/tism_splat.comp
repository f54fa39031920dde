// Imperfect shadow maps by tessellation (Barák et al. 2013): no points are kept; every triangle is halved, as
// each light sees it, until a piece is about as large as the map's texels, and the pieces are splatted. One
// invocation a cluster and light.
//
// The paper tessellates in hardware, with one factor an edge; here a triangle is halved at its longest edge,
// so that pieces near the light are smaller. Triangles below the size of a piece are drawn at random in
// proportion to their solid angle, only as many as are splatted.
#version 460
#include "types.h"
layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push {
  uint count, map_size, cluster_count;
  float piece;  // solid angle of the smallest piece, sr
};
#include "ism_surface.glsl"

const uint kDeepest = 14u;    // halvings
const float kSplatted = 6.0;  // longest edge, squared, of what is splatted, for a piece of 1 sr at 1 m
const float kLarge = 16.0;    // the same of a triangle to halve and not draw at random
const uint kMostRounds = MOST_ROUNDS;  // of one invocation; from half of them on nothing is halved
const float kMostSamples = 3000.0;     // of one cluster's small triangles

// Pieces of less solid angle than a texel would leave no more holes: the target is half a texel.
float piece_solid_angle(vec4 axis, vec3 w) {
  return max(piece, 0.5 * ism_texel_solid_angle(axis, w, map_size));
}

// Splats a piece that stands for its solid angle; a smaller one than asked for with that probability.
void splat_piece(uint k, vec3 a, vec3 b, vec3 c, vec4 axis, uint random) {
  vec3 d = (a + b + c) / 3.0;
  float distance2 = max(dot(d, d), 1e-12);
  vec3 w = d * inversesqrt(distance2), normal = cross(b - a, c - a);
  float solid_angle = 0.5 * abs(dot(normal, w)) / distance2;
  if (solid_angle > unit_float(random) * piece_solid_angle(axis, w)) splat(k, d, normal);
}

vec3 edges2(vec3 a, vec3 b, vec3 c) { return vec3(dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)); }
float most(vec3 v) { return max(v.x, max(v.y, v.z)); }

bool behind(vec3 a, vec3 b, vec3 c, vec4 axis) {
  return axis.w == 0.0 && most(vec3(dot(a, axis.xyz), dot(b, axis.xyz), dot(c, axis.xyz))) <= 0.0;
}

// Longest edge, squared, of a piece about as large as asked for.
float piece_edge2(vec3 a, vec3 b, vec3 c, vec4 axis) {
  vec3 d = (a + b + c) / 3.0;
  // Its nearest point is about at a vertex or the centroid.
  float near2 = min(min(dot(a, a), dot(b, b)), min(dot(c, c), dot(d, d)));
  return kSplatted * piece_solid_angle(axis, d * inversesqrt(max(dot(d, d), 1e-12))) * near2;
}

// Tessellates the triangles of a cluster from the first on while their longest edge, squared, is over
// `large`. Returns the first that is not. One loop over pieces, depth first; vertices are relative to the
// light.
uint tessellate(uint k, SurfaceCluster cluster, vec3 origin, vec4 axis, float large, uint random) {
  vec3 waiting[3 * kDeepest];  // second halves
  uint depth_of[kDeepest], n = 0u, depth = 0u, t = cluster.first, end = cluster.first + cluster.count;
  vec3 a, b, c;
  bool next = true;
  for (uint round = 0u; round < kMostRounds; ++round) {
    if (next) {
      uvec3 v = triangles[t];
      a = positions[v.x] - origin;
      b = positions[v.y] - origin;
      c = positions[v.z] - origin;
      depth = 0u;
      next = false;
      if (most(edges2(a, b, c)) <= large) return t;
    }
    vec3 edges = edges2(a, b, c);
    float longest = most(edges);
    bool hidden = behind(a, b, c, axis);
    if (!hidden && depth < kDeepest && 2u * round < kMostRounds && longest > piece_edge2(a, b, c, axis)) {
      // Turned so that ab is the longest edge, whose middle makes two halves.
      if (edges.y == longest) {
        vec3 first = a;
        a = b;
        b = c;
        c = first;
      } else if (edges.z == longest) {
        vec3 first = a;
        a = c;
        c = b;
        b = first;
      }
      vec3 middle = 0.5 * (a + b);
      depth += 1u;
      waiting[3u * n] = middle;
      waiting[3u * n + 1u] = b;
      waiting[3u * n + 2u] = c;
      depth_of[n++] = depth;
      b = middle;
      continue;
    }
    if (!hidden) splat_piece(k, a, b, c, axis, random_hash(random + round));
    if (n > 0u) {
      --n;
      a = waiting[3u * n];
      b = waiting[3u * n + 1u];
      c = waiting[3u * n + 2u];
      depth = depth_of[n];
    } else {
      if (++t == end) return t;
      next = true;
    }
  }
  return end;
}

// As many points of the triangles from `first` on as make up their solid angle in pieces.
void draw_points(uint k, SurfaceCluster cluster, uint first, vec3 origin, float target, uint random) {
  vec3 d = cluster.centre - origin;
  float distance = length(d);
  float before = first > cluster.first ? areas[first - 1u] : 0.0, area = cluster.area - before;
  float wanted = area * cluster_cosine(cluster, d / distance) / (distance * distance * target);
  uint samples = uint(min(wanted, kMostSamples) + unit_float(random));
  for (uint j = 0u; j < samples; ++j) {
    uint word = random_hash(random + j);
    uvec3 v = triangles[triangle_at(cluster, before + area * (float(j) + unit_float(word)) / float(samples))];
    vec2 u = sequence_point(j, uvec2(word, random_hash(word)));
    vec3 a = positions[v.x], b = positions[v.y], c = positions[v.z];
    splat(k, point_in(a, b, c, u) - origin, cross(b - a, c - a));
  }
}

void main() {
  uint i = gl_GlobalInvocationID.x, k = gl_GlobalInvocationID.y;
  if (i >= cluster_count || k >= count) return;
  SurfaceCluster cluster = clusters[i];
  vec3 origin = frames[2u * k].xyz;
  vec4 axis = frames[2u * k + 1u];
  vec3 d = cluster.centre - origin;
  if (axis.w == 0.0 && dot(d, axis.xyz) < -cluster.radius) return;
  float distance = length(d), near = distance - cluster.radius;
  float target = piece_solid_angle(axis, distance > 0.0 ? d / distance : axis.xyz);
  uint random = random_hash(uvec2(i, k));
  // All triangles of a cluster that the light is in; else the large ones, which come first.
  float large = near > 0.0 ? kLarge * target * near * near : 0.0;
  uint first = cluster.first;
  if (cluster.longest_edge * cluster.longest_edge > large) {
    first = tessellate(k, cluster, origin, axis, large, random);
  }
  if (first < cluster.first + cluster.count && near > 0.0) {
    draw_points(k, cluster, first, origin, target, random);
  }
}
