// What the kernels of `cut` share: the space that the tree cuts and its nodes.
//
// A point of that space has six coordinates: a texel's position, in RMS distances of the samples from their
// mean, and its normal as cut_texel.glsl weights it, times the parameter `direction`.
#ifndef VSGLBENCH_CUT_GLSL
#define VSGLBENCH_CUT_GLSL

#extension GL_EXT_scalar_block_layout : require

// World to tree: (position - origin) × scale.
struct Space {
  vec3 origin;
  float scale;
  uint valid;  // 0: the PDF chose no surface, there is nothing to cut
};

// A node of at least two lights that waits to be split. In the first rounds its slot is its place in a binary
// heap, 1 the root's; later it is first/2 behind the heap, which no two nodes share that have two lights
// each.
struct Task {
  uint round;       // in which it is split
  uint begin, end;  // its samples
  uint node;        // its index; inner nodes are numbered in preorder
  uint first;       // its first light
  uint budget;      // how many lights it may become
};

// An inner node. What lies below `threshold` along `axis` goes to node + 1, which has the first `left`
// lights; the rest goes to node + left. left = 0: the node was not split, all that it holds is its first
// light.
struct Node {
  uint axis_left;  // axis | left << 3
  float threshold;
};

uint node_axis(Node n) { return n.axis_left & 7u; }
uint node_left(Node n) { return n.axis_left >> 3; }

// Point i of an array of floats, six each.
#define STORE_POINT(array, i, p, d) \
  for (uint k = 0u; k < 3u; ++k) array[6u * (i) + k] = (p)[k], array[6u * (i) + 3u + k] = (d)[k]

// Coordinate `axis`: 0 to 2 of the position, 3 to 5 of the direction.
float along(vec3 position, vec3 direction, uint axis) {
  vec3 v = axis < 3u ? position : direction;
  uint k = axis < 3u ? axis : axis - 3u;
  return k == 0u ? v.x : k == 1u ? v.y : v.z;
}

#endif
