// Split planes of the radix tree, from the leaves up (Karras 2012, §4): of a node's two children the one that
// comes last goes on.
#version 460
#include "kd_box.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Sorted { TreeCentre sorted_centres[]; };
layout(set = 0, binding = 1, std430) readonly buffer Parents { uint parents[]; };
layout(set = 0, binding = 2, std430) coherent buffer Visits { uint visits[]; };
layout(set = 0, binding = 3, scalar) coherent buffer Boxes { Box boxes[]; };  // of both children of each node
layout(set = 0, binding = 4, scalar) buffer Nodes { TreeNode nodes[]; };
layout(push_constant) uniform Push { uint count, depth; };  // depth: nodes above a leaf at most

void main() {
  uint i = gl_GlobalInvocationID.x;
  bool climbing = i < count;
  Box box = empty_box();
  if (climbing) box = box_of(sorted_centres[i]);
  uint slot = climbing ? parents[count + i] : 0u;
  // Every invocation goes round equally often: a memory barrier may be one of execution too.
  for (uint step = 0u; step < depth; ++step) {
    if (climbing) boxes[slot] = box;
    memoryBarrierBuffer();
    if (climbing) climbing = atomicAdd(visits[slot / 2u], 1u) == 1u;  // else the other child goes on
    memoryBarrierBuffer();
    if (climbing) {
      Box other = boxes[slot ^ 1u];
      bool is_left = (slot & 1u) == 0u;
      TreeNode node = nodes[slot / 2u];
      if (is_left) {
        node = fitted(node, box, other);
      } else {
        node = fitted(node, other, box);
      }
      nodes[slot / 2u] = node;
      box = united(box, other);
      climbing = slot / 2u != 0u;
      if (climbing) slot = parents[slot / 2u];
    }
  }
}
