// Step 2, once a round: nodes of the tree are split, across the coordinate of largest variance, where that
// lowers the squared distances along it to the two parts' means most (Wan et al. 1988; of PLACES places). The
// parts share the node's lights: of a part's E = Σ|f-mean|², n lights on a surface leave about E/n, whose sum
// over both parts is least where n is as √E. An image shows of a light also its power, which the number m of
// samples stands for: n is as √(E√m).
#version 460
layout(set = 0, binding = 0, std430) readonly buffer From { float from[]; };
#define SAMPLES from
#include "cut_samples.glsl"
layout(set = 0, binding = 1, std430) writeonly buffer To { float to[]; };
layout(set = 0, binding = 2, scalar) buffer Tasks { Task tasks[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Nodes { Node nodes[]; };
layout(push_constant, std430) uniform Push {
  uint first_slot, slots;  // of the tasks that this round may have
  uint round, rounds;      // this one, and how many there are
  uint heap_rounds;        // the first of them, whose slots are those of a binary heap
};
#if LANES > 1
shared uint lefts[LANES];
#endif

const uint PLACES = 7u;
float place(uint k) { return 0.4 * float(k) - 1.2; }  // about the mean, in standard deviations

// Samples of this invocation.
struct Run {
  uint begin, end;
};

struct Cut {
  uint axis;
  float threshold;
  float gain;  // by how much it lowers the squared distances; 0: there is none
  uint lefts;  // samples of this invocation's run below it
};

// The axis of largest variance, and mean and deviation along it.
void widest(Run run, uint first, float count, out uint axis, out float mean, out float deviation) {
  vec3 base_p = sample_position(first), base_d = sample_direction(first);
  mat4 part = mat4(0.0);
  for (uint i = run.begin; i < run.end; ++i) {
    vec3 p = sample_position(i) - base_p, d = sample_direction(i) - base_d;
    part[0].xyz += p;
    part[1].xyz += p * p;
    part[2].xyz += d;
    part[3].xyz += d * d;
  }
  mat4 sum = reduce(part) / count;
  vec3 variance_p = sum[1].xyz - sum[0].xyz * sum[0].xyz, variance_d = sum[3].xyz - sum[2].xyz * sum[2].xyz;
  axis = 0u;
  for (uint a = 1u; a < 6u; ++a) {
    axis = along(variance_p, variance_d, a) > along(variance_p, variance_d, axis) ? a : axis;
  }
  mean = along(base_p, base_d, axis) + along(sum[0].xyz, sum[2].xyz, axis);
  deviation = sqrt(max(along(variance_p, variance_d, axis), 0.0));
}

Cut best_cut(Run run, uint first, float count) {
  uint axis;
  float mean, deviation;
  widest(run, first, count, axis, mean, deviation);
  // 1. Number and sum of what lies below each place.
  uint counts[PLACES];
  for (uint k = 0u; k < PLACES; ++k) counts[k] = 0u;
  vec4 sums0 = vec4(0.0), sums1 = vec4(0.0);
  for (uint i = run.begin; i < run.end; ++i) {
    float x = from[6u * i + axis];
    for (uint k = 0u; k < PLACES; ++k) {
      bool below = x < mean + place(k) * deviation;
      counts[k] += below ? 1u : 0u;
      float y = below ? x - mean : 0.0;
      if (k < 4u) {
        sums0[k] += y;
      } else {
        sums1[k - 4u] += y;
      }
    }
  }
  mat4 all = reduce(mat4(vec4(counts[0], counts[1], counts[2], counts[3]),
                         vec4(counts[4], counts[5], counts[6], 0.0), sums0, sums1));
  // 2. The place between the parts whose means differ most.
  Cut best = Cut(axis, 0.0, 0.0, 0u);
  for (uint k = 0u; k < PLACES; ++k) {
    float left = all[k / 4u][k % 4u], right = count - left, sum = all[2u + k / 4u][k % 4u];
    float gain = left > 0.0 && right > 0.0 ? sum * sum * (1.0 / left + 1.0 / right) : 0.0;
    if (gain > best.gain) best = Cut(axis, mean + place(k) * deviation, gain, counts[k]);
  }
  return best;
}

// How many samples of the invocations before this one go left, and of all.
uvec2 count_lefts(uint own) {
  uvec2 n = uvec2(0u, own);
#if LANES > 1
  uint lane = gl_LocalInvocationID.x;
  lefts[lane] = own;
  barrier();
  n = uvec2(0u);
  for (uint k = 0u; k < LANES; ++k) n += uvec2(k < lane ? lefts[k] : 0u, lefts[k]);
#endif
  return n;
}

// Moves the samples to their sides; returns (Σp, 0), (Σd, Σ|f|²) of the left and of the right, as offsets
// from sample `first`.
mat4 part_samples(Run run, uint first, Cut cut, uint left, uint right) {
  vec3 base_p = sample_position(first), base_d = sample_direction(first);
  mat4 part = mat4(0.0);
  for (uint i = run.begin; i < run.end; ++i) {
    vec3 p = sample_position(i), d = sample_direction(i);
    bool below = along(p, d, cut.axis) < cut.threshold;
    STORE_POINT(to, below ? left : right, p, d);
    left += below ? 1u : 0u;
    right += below ? 0u : 1u;
    p -= base_p;
    d -= base_d;
    vec4 a = vec4(p, 0.0), b = vec4(d, dot(p, p) + dot(d, d));
    part[0] += below ? a : vec4(0.0);
    part[1] += below ? b : vec4(0.0);
    part[2] += below ? vec4(0.0) : a;
    part[3] += below ? vec4(0.0) : b;
  }
  return reduce(part);
}

// E of a part of `count` samples.
float error(vec4 p, vec4 d, uint count) {
  return max(d.w - (dot(p.xyz, p.xyz) + dot(d.xyz, d.xyz)) / float(count), 0.0);
}

// What a part asks of lights.
float demand(float error, uint count) { return sqrt(error * sqrt(float(count)) + 1e-30); }

// The left part's lights: at least one for each, and no more than the rounds that are left can make.
uint share(uint budget, float l, float r) {
  uint most = min(1u << min(rounds - 1u - round, 30u), budget - 1u);
  return clamp(uint(float(budget) * (l / (l + r)) + 0.5), budget - most, most);
}

// Slot of a part of the task in `slot`.
uint part_slot(uint slot, bool right, uint first) {
  if (round + 1u < heap_rounds) return 2u * slot + (right ? 1u : 0u);
  return (1u << heap_rounds) + first / 2u;
}

void main() {
  uint slot = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * NODES + gl_LocalInvocationID.y;
  uint lane = gl_LocalInvocationID.x;
  if (slot >= slots) return;
  slot += first_slot;
  if (tasks[slot].round != round) return;
  Task task = tasks[slot];
  uint count = task.end - task.begin, length = (count + LANES - 1) / LANES;
  uint begin = min(task.begin + lane * length, task.end);
  Run run = Run(begin, min(begin + length, task.end));
  // 1. Where to cut.
  Cut cut = best_cut(run, task.begin, float(count));
  if (!(cut.gain > 0.0)) {
    if (lane == 0u) nodes[task.node] = Node(0u, 0.0);
    return;
  }
  // 2. The samples to their sides.
  uvec2 before = count_lefts(cut.lefts);
  uint middle = task.begin + before.y;
  mat4 sums =
      part_samples(run, task.begin, cut, task.begin + before.x, middle + (run.begin - task.begin - before.x));
  // 3. The two parts.
  if (lane != 0u) return;
  float left_error = error(sums[0], sums[1], before.y);
  float right_error = error(sums[2], sums[3], count - before.y);
  uint left = share(task.budget, demand(left_error, before.y), demand(right_error, count - before.y));
  nodes[task.node] = Node(cut.axis | left << 3, cut.threshold);
  uint second = task.first + left, right = task.budget - left;
  if (left > 1u) {
    tasks[part_slot(slot, false, task.first)] =
        Task(round + 1u, task.begin, middle, task.node + 1u, task.first, left);
  }
  if (right > 1u) {
    tasks[part_slot(slot, true, second)] =
        Task(round + 1u, middle, task.end, task.node + left, second, right);
  }
}
