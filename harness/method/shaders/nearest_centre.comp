// The nearest centre of every texel, by depth-first search of the kd-tree for a block of BLOCK_X × BLOCK_Y
// texels at once: a subtree is left out when it is further from the texels' box than every texel's best so
// far. A block of one texel is the usual search. All bounds are sums of the same rounded terms as the
// distances, none of which decreases with the coordinate difference, so in single precision too they never
// leave out a centre that is as near as the best.
#version 460
#include "kd_tree.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D position_map;  // xyz, w > 0 where there is a surface
layout(set = 0, binding = 1, scalar) readonly buffer Nodes { TreeNode nodes[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Sorted { TreeCentre sorted_centres[]; };
layout(set = 0, binding = 3, std430) writeonly buffer Ids { uint ids[]; };
layout(push_constant) uniform Push { uint width, height, count; };

#if DIMENSIONS == 2
#define Point vec2
float squared(vec2 d) {
  precise float s = d.x * d.x + d.y * d.y;
  return s;
}
float along(vec2 v, uint axis) { return axis == 0u ? v.x : v.y; }
vec2 replaced(vec2 v, uint axis, float x) { return vec2(axis == 0u ? x : v.x, axis == 1u ? x : v.y); }
#else
#define Point vec3
float squared(vec3 d) {
  precise float s = (d.x * d.x + d.y * d.y) + d.z * d.z;
  return s;
}
float along(vec3 v, uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }
vec3 replaced(vec3 v, uint axis, float x) {
  return vec3(axis == 0u ? x : v.x, axis == 1u ? x : v.y, axis == 2u ? x : v.z);
}
#endif

const uint TEXELS = BLOCK_X * BLOCK_Y;  // at most 32
// A path has at most 31 code bits and 21 rank bits, and leaves one subtree behind at each.
const uint STACK = 56u;

// The block's texels; `best`, the squared distance to `nearest`, is -1 where nothing may be found.
Point query[TEXELS];
float best[TEXELS];
uint nearest[TEXELS];

uvec2 texel_at(uvec2 corner, uint k) { return corner + uvec2(k % BLOCK_X, k / BLOCK_X); }

// Returns a bit for each texel that has a surface.
uint load_texels(uvec2 corner) {
  uint found = 0u;
  for (uint k = 0u; k < TEXELS; ++k) {
    uvec2 at = texel_at(corner, k);
    vec4 position = texelFetch(position_map, ivec2(min(at, uvec2(width, height) - 1u)), 0);
    bool surface = position.w > 0.0 && at.x < width && at.y < height;
#if DIMENSIONS == 2
    query[k] = vec2(at) + 0.5;
#else
    query[k] = position.xyz;
#endif
    best[k] = surface ? INFINITY : -1.0;
    nearest[k] = NO_CENTRE;
    found |= surface ? 1u << k : 0u;
  }
  return found;
}

// A leaf's centres against all texels; of equally near centres the first wins. Returns the largest squared
// distance to `from`.
float try_leaf(uint first, uint size, Point from) {
  float furthest = 0.0;
  for (uint c = first; c < first + size; ++c) {
    TreeCentre centre = sorted_centres[c];
    Point at = Point(centre.position);
    for (uint k = 0u; k < TEXELS; ++k) {
      float d = squared(query[k] - at);
      bool nearer = d < best[k] || (d == best[k] && centre.id < nearest[k]);
      best[k] = nearer ? d : best[k];
      nearest[k] = nearer ? centre.id : nearest[k];
    }
    furthest = max(furthest, centre.id != NO_CENTRE ? squared(from - at) : 0.0);
  }
  return furthest;
}

uint root() { return make_reference(0u, count - 1u, 0u); }

// The leaf on whose side of every plane `from` lies.
uint leaf_round(Point from) {
  uint reference = root();
  while (!is_leaf(reference)) {
    TreeNode node = nodes[reference & INDEX_MASK];
    float x = along(from, node.left >> AXIS_SHIFT & 3u);
    reference = x - node.left_max <= node.right_min - x ? node.left & ~AXIS_MASK : node.right;
  }
  return reference;
}

// The largest of the best distances in the group.
float worst_of(uint group) {
  float worst = 0.0;
  for (uint k = 0u; k < TEXELS; ++k) worst = (group & 1u << k) != 0u ? max(worst, best[k]) : worst;
  return worst;
}

// The nearest centres of the group's texels. What lies in leaf `tried` is known already.
void search(uint group, uint tried) {
  Point low = Point(INFINITY), high = Point(-INFINITY);
  for (uint k = 0u; k < TEXELS; ++k) {
    bool is_in = (group & 1u << k) != 0u;
    low = is_in ? min(low, query[k]) : low;
    high = is_in ? max(high, query[k]) : high;
  }
  Point middle = 0.5 * low + 0.5 * high;
  float worst = worst_of(group);

  uint stack[STACK];
  Point stack_side[STACK];
  uint top = 0u, reference = root();
  Point side = Point(0.0);  // distance to the subtree, axis by axis
  for (bool searching = true; searching;) {
    // 1. Down to the nearest leaf, keeping the other children that may hold something.
    while (!is_leaf(reference)) {
      TreeNode node = nodes[reference & INDEX_MASK];
      uint axis = node.left >> AXIS_SHIFT & 3u;
      float before = along(side, axis), m = along(middle, axis);
      float left = max(before, along(low, axis) - node.left_max);
      float right = max(before, node.right_min - along(high, axis));
      bool left_first = m - node.left_max <= node.right_min - m;
      Point far = replaced(side, axis, left_first ? right : left);
      float bound = squared(far);
      if (bound <= worst && bound < INFINITY) {
        stack[top] = left_first ? node.right : node.left & ~AXIS_MASK;
        stack_side[top] = far;
        ++top;
      }
      reference = left_first ? node.left & ~AXIS_MASK : node.right;
      side = replaced(side, axis, left_first ? left : right);
    }
    // 2. Its centres.
    try_leaf(reference & INDEX_MASK, reference == tried ? 0u : leaf_size(reference), middle);
    worst = worst_of(group);
    // 3. Back to what was kept last and is still near enough.
    searching = false;
    while (top > 0u && !searching) {
      --top;
      side = stack_side[top];
      searching = squared(side) <= worst;
    }
    reference = stack[top];
  }
}

// The texels of `left` that lie together, measured by how far apart the centres are round one of them: a
// block that spans a jump of depth, or many centres, falls into several such groups.
uint next_group(uint left, out uint tried) {
  Point from = query[0];
  for (uint k = 1u; k < TEXELS; ++k) from = findLSB(left) == int(k) ? query[k] : from;
  tried = leaf_round(from);
  float furthest = try_leaf(tried & INDEX_MASK, leaf_size(tried), from);
  uint group = left & (~left + 1u);
  for (uint k = 0u; k < TEXELS; ++k) {
    group |= squared(query[k] - from) <= 0.25 * furthest ? left & 1u << k : 0u;
  }
  return group;
}

void main() {
  // Neighbouring invocations take blocks that lie together, 4 × 2 of them at a time.
  uint l = gl_LocalInvocationID.x;
  uvec2 block = gl_WorkGroupID.xy * 8u + uvec2((l & 3u) | (l >> 1 & 4u), (l >> 2 & 1u) | (l >> 3 & 6u));
  uvec2 corner = block * uvec2(BLOCK_X, BLOCK_Y);
  if (corner.x >= width || corner.y >= height) return;
  uint left = load_texels(corner);
  while (left != 0u) {
    uint group = left, tried = 0u;  // 0 is no leaf
    if (TEXELS > 1u) group = next_group(left, tried);
    search(group, tried);
    left &= ~group;
  }
  for (uint k = 0u; k < TEXELS; ++k) {
    uvec2 at = texel_at(corner, k);
    if (at.x < width && at.y < height) ids[at.y * width + at.x] = min(nearest[k], count);
  }
}
