// Step 3: the light of each texel; `count` where it has no surface, or the PDF chose none. One invocation
// takes a block of BLOCK_X × BLOCK_Y texels down the tree together and parts them only where a cut does.
#version 460
#include "cut.glsl"
layout(local_size_x = 64) in;
#include "cut_texel.glsl"
layout(set = 0, binding = AFTER_MAPS, scalar) readonly buffer Spaces { Space space; };
layout(set = 0, binding = AFTER_MAPS + 1, scalar) readonly buffer Nodes { Node nodes[]; };
layout(set = 0, binding = AFTER_MAPS + 2, std430) writeonly buffer Ids { uint ids[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;
  float direction_length, glossy;
};

const uint TEXELS = BLOCK_X * BLOCK_Y;  // at most 32

// The block's texels in the tree's space, their lights, and the box round them.
vec3 position[TEXELS], direction[TEXELS];
uint light[TEXELS];
vec3 low_p = vec3(1e30), low_d = vec3(1e30), high_p = vec3(-1e30), high_d = vec3(-1e30);

uvec2 texel_at(uvec2 corner, uint k) { return corner + uvec2(k % BLOCK_X, k / BLOCK_X); }

// Returns a bit for each texel that has a surface.
uint load_texels(uvec2 corner) {
  uint found = 0u;
  for (uint k = 0u; k < TEXELS; ++k) {
    uvec2 at = texel_at(corner, k);
    ivec2 inside = ivec2(min(at, uvec2(emitter.width, emitter.height) - 1u));
    vec3 p, d;
    bool surface = load_point(emitter, inside, glossy, p, d) && at.x < emitter.width && at.y < emitter.height;
    position[k] = (p - space.origin) * space.scale;
    direction[k] = direction_length * d;
    light[k] = count;
    found |= surface ? 1u << k : 0u;
    low_p = surface ? min(low_p, position[k]) : low_p;
    low_d = surface ? min(low_d, direction[k]) : low_d;
    high_p = surface ? max(high_p, position[k]) : high_p;
    high_d = surface ? max(high_d, direction[k]) : high_d;
  }
  return found;
}

// Some texels on their way down.
struct Group {
  uint texels;  // a bit each
  uint node, first, budget;
};

bool is_leaf(Group g) { return g.budget < 2u; }
Group left_of(Group g, uint left, uint texels) { return Group(texels, g.node + 1u, g.first, left); }
Group right_of(Group g, uint left, uint texels) {
  return Group(texels, g.node + left, g.first + left, g.budget - left);
}

// Down to a leaf, or to the first plane that may part the block.
Group descend_together(uint texels) {
  Group g = Group(texels, 0u, 0u, count);
  for (bool together = true; together && !is_leaf(g);) {
    Node n = nodes[g.node];
    uint left = node_left(n);
    if (left == 0u) {
      g.budget = 1u;
    } else if (along(high_p, high_d, node_axis(n)) < n.threshold) {
      g = left_of(g, left, texels);
    } else if (along(low_p, low_d, node_axis(n)) >= n.threshold) {
      g = right_of(g, left, texels);
    } else {
      together = false;
    }
  }
  return g;
}

// The texels of `g` that are below the plane of `n`.
uint below(Node n, uint texels) {
  uint found = 0u;
  for (uint k = 0u; k < TEXELS; ++k) {
    found |= along(position[k], direction[k], node_axis(n)) < n.threshold ? 1u << k : 0u;
  }
  return found & texels;
}

void descend(Group g) {
  Group stack[TEXELS];  // groups of other texels, none empty
  uint top = 0u;
  for (bool on = g.texels != 0u; on;) {
    Node n = Node(0u, 0.0);
    if (!is_leaf(g)) n = nodes[g.node];
    uint left = node_left(n);
    if (left == 0u) {
      for (uint k = 0u; k < TEXELS; ++k) light[k] = (g.texels & 1u << k) != 0u ? g.first : light[k];
      on = top > 0u;
      if (on) g = stack[--top];
    } else {
      uint l = below(n, g.texels), r = g.texels & ~l;
      if (l != 0u && r != 0u) stack[top++] = right_of(g, left, r);
      if (l != 0u) {
        g = left_of(g, left, l);
      } else {
        g = right_of(g, left, r);
      }
    }
  }
}

void main() {
  // Neighbouring invocations take blocks that lie together, 4 × 2 of them at a time.
  uint l = gl_LocalInvocationID.x;
  uvec2 block = gl_WorkGroupID.xy * 8u + uvec2((l & 3u) | (l >> 1 & 4u), (l >> 2 & 1u) | (l >> 3 & 6u));
  uvec2 corner = block * uvec2(BLOCK_X, BLOCK_Y);
  if (corner.x >= emitter.width || corner.y >= emitter.height) return;
  uint texels = load_texels(corner);
  if (space.valid == 0u) texels = 0u;
  descend(descend_together(texels));
  for (uint k = 0u; k < TEXELS; ++k) {
    uvec2 at = texel_at(corner, k);
    if (at.x < emitter.width && at.y < emitter.height) ids[at.y * emitter.width + at.x] = light[k];
  }
}
