// Split planes of the radix tree, from the leaves up (Karras 2012, §4): of a node's two children the one that
// comes last goes on. The planes are the centres' own coordinates, so that they bound exactly in single
// precision.
#version 460
#include "kd_tree.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Sorted { TreeCentre sorted_centres[]; };
layout(set = 0, binding = 1, std430) readonly buffer Parents { uint parents[]; };
layout(set = 0, binding = 2, std430) coherent buffer Visits { uint visits[]; };
struct Box {
  vec3 low, high;
};
layout(set = 0, binding = 3, scalar) coherent buffer Boxes { Box boxes[]; };  // of both children of each node
layout(set = 0, binding = 4, scalar) buffer Nodes { TreeNode nodes[]; };
layout(push_constant) uniform Push { uint count, depth; };  // depth: nodes above a leaf at most

// The axis along which the children are furthest apart.
void fit(uint node, Box left, Box right) {
  vec3 gap = right.low - left.high;
  uint axis = gap.y > gap.x ? 1u : 0u;
#if DIMENSIONS == 3
  if (gap.z > gap[axis]) axis = 2u;
#endif
  nodes[node].left |= axis << AXIS_SHIFT;
  nodes[node].left_max = left.high[axis];
  nodes[node].right_min = right.low[axis];
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  bool climbing = i < count;
  Box box = Box(vec3(INFINITY), vec3(-INFINITY)), other;
  if (climbing && sorted_centres[i].id != NO_CENTRE) {
    box.low = sorted_centres[i].position;
    box.high = box.low;
  }
  uint slot = climbing ? parents[count + i] : 0u;
  // Every invocation goes round equally often: a memory barrier may be one of execution too.
  for (uint step = 0u; step < depth; ++step) {
    if (climbing) boxes[slot] = box;
    memoryBarrierBuffer();
    if (climbing) climbing = atomicAdd(visits[slot / 2u], 1u) == 1u;  // else the other child goes on
    memoryBarrierBuffer();
    if (climbing) {
      other = boxes[slot ^ 1u];
      if ((slot & 1u) == 0u) {
        fit(slot / 2u, box, other);
      } else {
        fit(slot / 2u, other, box);
      }
      box = Box(min(box.low, other.low), max(box.high, other.high));
      climbing = slot / 2u != 0u;
      if (climbing) slot = parents[slot / 2u];
    }
  }
}
