// Internal nodes of a binary radix tree over sorted Morton codes, all at once (Karras, "Maximizing
// Parallelism in the Construction of BVHs, Octrees, and k-d Trees", HPG 2012, Fig. 4); equal codes are told
// apart by rank.
#version 460
#include "kd_tree.glsl"
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Centres { vec4 centres[]; };
layout(set = 0, binding = 1, std430) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 2, std430) readonly buffer Ids { uint ids[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Sorted { TreeCentre sorted_centres[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Nodes { TreeNode nodes[]; };
// Twice the parent, plus 1 for a right child: of internal node i at i, of leaf i at count + i.
layout(set = 0, binding = 5, std430) writeonly buffer Parents { uint parents[]; };
layout(set = 0, binding = 6, std430) writeonly buffer Visits { uint visits[]; };
layout(push_constant) uniform Push { uint count; };

// Length of the common prefix of keys i and j; -1 outside.
int prefix(int i, int j) {
  if (j < 0 || j >= int(count)) return -1;
  uint a = codes[i], b = codes[j];
  return a != b ? 31 - findMSB(a ^ b) : 63 - findMSB(uint(i ^ j));
}

void store_centre(uint i) {
  vec4 c = centres[ids[i]];
  vec4 before = i > 0u ? centres[ids[i - 1u]] : vec4(0.0);
  bool none = !(c.w > 0.0) || (before.w > 0.0 && before.xyz == c.xyz);
  sorted_centres[i] = none ? TreeCentre(vec3(INFINITY), NO_CENTRE) : TreeCentre(c.xyz, ids[i]);
}

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= int(count)) return;
  store_centre(uint(i));
  if (i >= int(count) - 1) return;
  // Direction of the range, and an upper bound of its length.
  int d = prefix(i, i + 1) > prefix(i, i - 1) ? 1 : -1;
  int shortest = prefix(i, i - d), bound = 2;
  while (prefix(i, i + bound * d) > shortest) bound *= 2;
  // Its other end, by bisection.
  int len = 0;
  for (int t = bound / 2; t > 0; t /= 2) len += prefix(i, i + (len + t) * d) > shortest ? t : 0;
  int j = i + len * d, shared_bits = prefix(i, j);
  // The split: the last key that shares more than the common prefix with key i.
  int s = 0;
  for (int t = len; t > 1;) {
    t = (t + 1) / 2;
    if (s + t <= len && prefix(i, i + (s + t) * d) > shared_bits) s += t;
  }
  int split = i + s * d + min(d, 0), first = min(i, j), last = max(i, j);
  uint n = count;
  nodes[i] = TreeNode(make_reference(uint(first), uint(split), uint(split)),
                      make_reference(uint(split + 1), uint(last), uint(split + 1)), 0.0, 0.0);
  parents[first == split ? n + uint(split) : uint(split)] = 2u * uint(i);
  parents[last == split + 1 ? n + uint(split + 1) : uint(split + 1)] = 2u * uint(i) + 1u;
  visits[i] = 0u;
}
