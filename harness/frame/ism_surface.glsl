// The scene's surface in clusters (ism_surface.h) at bindings 0 to 3, and splatting from it into the maps at
// bindings 4 and 5. The including file declares `map_size`.
#define ISM_WRITE
#include "ism.glsl"
#include "random.glsl"

struct SurfaceCluster {
  vec3 centre;
  float radius;
  uint first, count;
  float area;
  float longest_edge;
  float facing[6];
};
layout(set = 0, binding = 0, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Triangles { uvec3 triangles[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Areas { float areas[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Clusters { SurfaceCluster clusters[]; };
layout(set = 0, binding = 4, std430) readonly buffer Frames { vec4 frames[]; };
layout(set = 0, binding = 5, std430) buffer Maps { uint maps[]; };

// Root mean square of |cos| between `direction` and the normals of a cluster: exact where it is flat.
float cluster_cosine(SurfaceCluster c, vec3 w) {
  return sqrt(max(c.facing[0] * w.x * w.x + c.facing[1] * w.y * w.y + c.facing[2] * w.z * w.z +
                      2.0 * (c.facing[3] * w.x * w.y + c.facing[4] * w.x * w.z + c.facing[5] * w.y * w.z),
                  0.0));
}

// The triangle of a cluster that holds this much of its area (m²) before it.
uint triangle_at(SurfaceCluster c, float area) {
  uint low = c.first, high = c.first + c.count - 1u;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (areas[middle] <= area)
      low = middle + 1u;
    else
      high = middle;
  }
  return low;
}

// Uniform over a triangle for u uniform in the unit square.
vec3 point_in(vec3 a, vec3 b, vec3 c, vec2 u) {
  float s = sqrt(u.x);
  return (1.0 - s) * a + s * ((1.0 - u.y) * b + u.y * c);
}

// A point at `d` from the light on a surface with this normal, of any length.
void splat(uint k, vec3 d, vec3 normal) {
  float distance = length(d);
  if (distance <= frames[2u * k].w) return;
  vec3 w = d / distance;
  vec4 axis = frames[2u * k + 1u];
  uvec2 texel;
  if (!ism_texel(axis, w, map_size, texel)) return;
  float depth = ism_depth(distance, w, normalize(normal), axis, map_size);
  atomicMin(maps[(k * map_size + texel.y) * map_size + texel.x], floatBitsToUint(depth));
}
