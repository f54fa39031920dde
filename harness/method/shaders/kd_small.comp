// The whole kd-tree over few centres, by one workgroup: what kd_bounds, kd_codes, the radix sort, kd_build
// and kd_fit do for many, without the dispatches and barriers between them, which take longer than the work
// does. Unlike kd_build, nodes are made from the root down, and none within a leaf; they lie in the order of
// their levels, and are fitted from the last level to the first.
#version 460
#include "kd_box.glsl"
#include "kd_morton.glsl"
#define LANES 64u
#define DIGIT_BITS 6u  // of a pass of the sort: as many digits as lanes
#define DIGITS (1u << DIGIT_BITS)
#define MOST_LEVELS 64  // a path tells code bits apart, then ranks
layout(local_size_x = LANES) in;
layout(set = 0, binding = 0, std430) readonly buffer Centres { vec4 centres[]; };
layout(set = 0, binding = 1, scalar) coherent buffer Sorted { TreeCentre sorted_centres[]; };
layout(set = 0, binding = 2, scalar) coherent buffer Nodes { TreeNode nodes[]; };
layout(set = 0, binding = 3, std430) coherent buffer Words { uint words[]; };  // 4 a centre
layout(set = 0, binding = 4, scalar) coherent buffer Boxes { Box boxes[]; };   // of each node
layout(push_constant) uniform Push { uint count; };

// Of each digit and lane; a row is one longer, so that lanes that read a column each find it in banks of
// their own.
shared uint counters[DIGITS * (LANES + 1u)];
shared uint totals[DIGITS];
shared Box lane_boxes[LANES];
shared uint level_ends[MOST_LEVELS], node_count;

uint lane() { return gl_LocalInvocationID.x; }
void everyone() {
  memoryBarrierBuffer();
  barrier();
}

// `words`: two sets of keys and values, of which the sort fills one from the other. When it is done, the
// first set holds the nodes' first and last centres.
uint key_at(uint set, uint i) { return 2u * set * count + i; }
uint value_at(uint set, uint i) { return (2u * set + 1u) * count + i; }

Box all_centres() {
  Box own = empty_box();
  for (uint i = lane(); i < count; i += LANES) {
    vec4 c = centres[i];
    if (c.w > 0.0) own = united(own, Box(c.xyz, c.xyz));
  }
  lane_boxes[lane()] = own;
  for (uint half_size = LANES / 2u; half_size > 0u; half_size /= 2u) {
    barrier();
    if (lane() < half_size) lane_boxes[lane()] = united(lane_boxes[lane()], lane_boxes[lane() + half_size]);
  }
  barrier();
  return lane_boxes[0];
}

// What is no centre has the last code.
void store_codes(Box all) {
  for (uint i = lane(); i < count; i += LANES) {
    vec4 c = centres[i];
    words[key_at(0u, i)] = c.w > 0.0 ? morton_code(c.xyz, all.low, all.high) : (1u << CODE_BITS) - 1u;
    words[value_at(0u, i)] = i;
  }
  everyone();
}

// One pass of a stable radix sort by counting; every lane counts and moves a run of its own.
void sort_by_digit(uint shift, uint from) {
  uint length = (count + LANES - 1u) / LANES;
  uint first = min(lane() * length, count), last = min(first + length, count);
  // 1. Each lane's digits.
  for (uint d = 0u; d < DIGITS; ++d) counters[d * (LANES + 1u) + lane()] = 0u;
  for (uint i = first; i < last; ++i) {
    uint digit = words[key_at(from, i)] >> shift & (DIGITS - 1u);
    ++counters[digit * (LANES + 1u) + lane()];
  }
  barrier();
  // 2. Where each lane's part of a digit starts: lane d goes through digit d.
  uint row = lane() * (LANES + 1u), sum = 0u;
  for (uint l = 0u; l < LANES; ++l) sum += counters[row + l];
  totals[lane()] = sum;
  barrier();
  uint next = 0u;
  for (uint d = 0u; d < lane(); ++d) next += totals[d];
  for (uint l = 0u; l < LANES; ++l) {
    uint n = counters[row + l];
    counters[row + l] = next;
    next += n;
  }
  barrier();
  // 3. Each pair to its place.
  for (uint i = first; i < last; ++i) {
    uint key = words[key_at(from, i)], counter = (key >> shift & (DIGITS - 1u)) * (LANES + 1u) + lane();
    uint to = counters[counter];
    counters[counter] = to + 1u;
    words[key_at(1u - from, to)] = key;
    words[value_at(1u - from, to)] = words[value_at(from, i)];
  }
  everyone();
}

uint code(uint i) { return words[key_at(1u, i)]; }
void store_centres() {
  for (uint i = lane(); i < count; i += LANES) {
    uint id = words[value_at(1u, i)];
    vec4 c = centres[id], before = i > 0u ? centres[words[value_at(1u, i - 1u)]] : vec4(0.0);
    bool none = !(c.w > 0.0) || (before.w > 0.0 && before.xyz == c.xyz);
    sorted_centres[i] = none ? TreeCentre(vec3(INFINITY), NO_CENTRE) : TreeCentre(c.xyz, id);
  }
}

// The last centre of the left child: where the highest bit that the codes differ in changes, or half way of
// equal codes.
uint split_of(uint first, uint last) {
  uint low = code(first), different = low ^ code(last);
  if (different == 0u) return (first + last) / 2u;
  uint above = ~0u << uint(findMSB(different));
  uint left = first, right = last;  // the code of `left` is on the left side, that of `right` is not
  while (right - left > 1u) {
    uint middle = (left + right) / 2u;
    if (((code(middle) ^ low) & above) == 0u) {
      left = middle;
    } else {
      right = middle;
    }
  }
  return left;
}

// The reference to a child, which is queued where it is no leaf.
uint child(uint first, uint last) {
  if (last - first < LEAF_SIZE) return make_reference(first, last, 0u);
  uint node = atomicAdd(node_count, 1u);
  words[key_at(0u, node)] = first;
  words[value_at(0u, node)] = last;
  return node;
}

// Returns the number of levels; those of level l lie before level_ends[l].
uint build() {
  if (lane() == 0u) {
    words[key_at(0u, 0u)] = 0u;
    words[value_at(0u, 0u)] = count - 1u;
    node_count = 1u;
  }
  everyone();
  uint levels = 0u, from = 0u, to = 1u;
  while (from < to && levels < MOST_LEVELS) {
    for (uint node = from + lane(); node < to; node += LANES) {
      uint first = words[key_at(0u, node)], last = words[value_at(0u, node)], split = split_of(first, last);
      nodes[node] = TreeNode(child(first, split), child(split + 1u, last), 0.0, 0.0);
    }
    if (lane() == 0u) level_ends[levels] = to;
    ++levels;
    everyone();
    from = to;
    to = node_count;
    barrier();
  }
  return levels;
}

Box box_of(uint reference) {
  if (!is_leaf(reference)) return boxes[reference & INDEX_MASK];
  uint first = reference & INDEX_MASK;
  Box box = empty_box();
  for (uint i = first; i < first + leaf_size(reference); ++i) box = united(box, box_of(sorted_centres[i]));
  return box;
}

void fit(uint levels) {
  for (uint level = levels; level > 0u; --level) {
    uint from = level > 1u ? level_ends[level - 2u] : 0u, to = level_ends[level - 1u];
    for (uint node = from + lane(); node < to; node += LANES) {
      Box left = box_of(nodes[node].left), right = box_of(nodes[node].right);
      nodes[node] = fitted(nodes[node], left, right);
      boxes[node] = united(left, right);
    }
    everyone();
  }
}

void main() {
  store_codes(all_centres());
  uint set = 0u;
  for (uint shift = 0u; shift < CODE_BITS; shift += DIGIT_BITS) {  // five passes: the second set is the last
    sort_by_digit(shift, set);
    set = 1u - set;
  }
  store_centres();
  if (count > LEAF_SIZE) fit(build());
}
