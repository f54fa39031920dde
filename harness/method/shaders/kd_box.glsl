// Boxes round the centres of a kd-tree's nodes, and the split planes they give.
#ifndef VSGLBENCH_KD_BOX_GLSL
#define VSGLBENCH_KD_BOX_GLSL

#include "kd_tree.glsl"

struct Box {
  vec3 low, high;
};
Box empty_box() { return Box(vec3(INFINITY), vec3(-INFINITY)); }
Box united(Box a, Box b) { return Box(min(a.low, b.low), max(a.high, b.high)); }
// What is no centre takes no room.
Box box_of(TreeCentre centre) {
  if (centre.id == NO_CENTRE) return empty_box();
  return Box(centre.position, centre.position);
}

// The node with its plane, across the axis along which its children are furthest apart. The planes are the
// centres' own coordinates, so that they bound exactly in single precision.
TreeNode fitted(TreeNode node, Box left, Box right) {
  vec3 gap = right.low - left.high;
  uint axis = gap.y > gap.x ? 1u : 0u;
#if DIMENSIONS == 3
  if (gap.z > gap[axis]) axis = 2u;
#endif
  return TreeNode(node.left | axis << AXIS_SHIFT, node.right, left.high[axis], right.low[axis]);
}

#endif
