// The kd-tree over cluster centres: what kd_build.comp and kd_fit.comp make and nearest_centre.comp reads.
#ifndef VSGLBENCH_KD_TREE_GLSL
#define VSGLBENCH_KD_TREE_GLSL

#extension GL_EXT_scalar_block_layout : require

#define INFINITY uintBitsToFloat(0x7F800000u)
const uint NO_CENTRE = 0xFFFFFFFFu;

// A centre at its place along the Morton curve. One that is none, or that lies exactly on its predecessor,
// has id NO_CENTRE and stands at infinity: no query comes near it.
struct TreeCentre {
  vec3 position;
  uint id;
};

// Every centre of the left child has x[axis] <= left_max, every one of the right x[axis] >= right_min.
struct TreeNode {
  uint left, right;  // references; bits 29-30 of `left` hold this node's axis
  float left_max, right_min;
};

// A reference: bit 31 says leaf; then bits 25-28 are its size - 1 and bits 0-24 its first centre. Else an
// internal node.
const uint LEAF = 1u << 31, INDEX_MASK = (1u << 25) - 1u;
const uint AXIS_SHIFT = 29, AXIS_MASK = 3u << AXIS_SHIFT, SIZE_SHIFT = 25;
bool is_leaf(uint reference) { return (reference & LEAF) != 0u; }
uint leaf_size(uint reference) { return ((reference >> SIZE_SHIFT) & 15u) + 1u; }
uint make_reference(uint first, uint last, uint internal_node) {
  uint size = last - first + 1u;
  return size <= LEAF_SIZE ? LEAF | (size - 1u) << SIZE_SHIFT | first : internal_node;
}

#endif
