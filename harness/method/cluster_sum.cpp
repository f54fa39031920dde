#include "method/cluster_sum.h"

#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "gpu/limits.h"

namespace vsglbench {
namespace {

constexpr uint32_t kBlock = 64;  // as BLOCK in shaders/cluster_sum.glsl
constexpr uint32_t kGroup = 32;  // as GROUP there
// Texels of one cluster that a dispatch of the linear sum goes through on lavapipe: each texel is a round,
// each 64 another, each 4096 a third.
constexpr uint32_t kMostTexels = 15 * kBlock * kBlock;
static_assert(kMostTexels + kMostTexels / kBlock + kMostTexels / (kBlock * kBlock) < limits::loop_rounds);

void check(const ClusterSum::SortedTexels& sorted, const LightTarget& target, unsigned lobes) {
  const auto see = [](const Buffer* buffer, size_t bytes, const char* name) {
    if (!buffer) throw std::logic_error(fmt::format("cluster sum: no {}", name));
    if (buffer->size() < bytes) {
      throw std::logic_error(
          fmt::format("cluster sum: {} bytes of {}, {} needed", buffer->size(), name, bytes));
    }
  };
  see(sorted.ids, size_t(sorted.count) * 4, "ids");
  see(sorted.texels, size_t(sorted.count) * 4, "texels");
  see(target.buffer, target.count * light_stride(LightKind::vsgl, lobes), "lights");
}

// Pieces of the next level at most, whatever the clusters' sizes: each cluster has one that isn't full.
uint32_t piece_bound(uint32_t items, uint32_t clusters) { return std::min(items, items / kBlock + clusters); }

// One invocation an item; in two dimensions, as a device may allow no more than limits::groups in one.
template <class Push>
void dispatch_items(Recorder& r, const Kernel& kernel, const Bindings& bindings, const Push& push,
                    uint32_t items) {
  const uint32_t groups = groups_for(items, kGroup), rows = groups_for(groups, limits::groups);
  r.dispatch(kernel, bindings, push, groups_for(groups, std::max(rows, 1u)), rows);
}

}  // namespace

ClusterSum::ClusterSum(MethodContext& context, ClusterSumVariant variant)
    : context_(context), variant_(variant), starts_(&context.shared_kernel("cluster_starts.comp")) {
  if (variant == ClusterSumVariant::per_cluster) {
    linear_ = &context.shared_kernel("cluster_linear.comp");
    return;
  }
  pieces_ = &context.shared_kernel("cluster_pieces.comp");
  leaves_ = &context.shared_kernel("cluster_leaves.comp");
  partials_ = &context.shared_kernel("cluster_partials.comp");
  lights_ = &context.shared_kernel("cluster_lights.comp");
}

void ClusterSum::record(Recorder& recorder, const Field& field, const SortedTexels& sorted,
                        const LightTarget& target) {
  check(sorted, target, context_.lobes());
  if (target.count == 0) return;
  if (variant_ == ClusterSumVariant::per_cluster) {
    record_linear(recorder, field, sorted, target);
  } else {
    record_segmented(recorder, field, sorted, target);
  }
  recorder.barrier();
}

const Buffer& ClusterSum::scratch(Half half, const char* name, size_t bytes) {
  return context_.scratch(fmt::format("cluster.{}.{}", name, half_name(half)), std::max<size_t>(bytes, 4));
}

void ClusterSum::record_linear(Recorder& r, const Field& field, const SortedTexels& sorted,
                               const LightTarget& target) {
  const Buffer& starts = record_starts(r, field, sorted, target.count, 1);
  const bool cpu = context_.device().is_cpu();
  const uint32_t most = cpu ? kMostTexels : groups_for(sorted.count, kBlock * kBlock) * kBlock * kBlock;
  const Buffer& unfinished =
      scratch(field.half, "unfinished", target.count * moments_bytes(context_.lobes()));
  uint32_t round = 0;
  do {
    const struct {
      gpu::Emitter emitter;
      uint32_t clusters, most, round;
    } push{field.emitter, target.count, std::max(most, 1u), round};
    dispatch_items(r, *linear_, {field.maps, *sorted.texels, starts, unfinished, *target.buffer}, push,
                   target.count);
    r.barrier();
  } while (uint64_t{++round} * most < sorted.count);
}

const Buffer& ClusterSum::record_starts(Recorder& r, const Field& field, const SortedTexels& sorted,
                                        uint32_t clusters, uint32_t levels) {
  const Buffer& starts = scratch(field.half, "starts", size_t(levels) * (clusters + 1) * 4);
  const struct { uint32_t count, clusters; } push{sorted.count, clusters};
  dispatch_items(r, *starts_, {*sorted.ids, starts}, push, clusters + 1);
  r.barrier();
  return starts;
}

void ClusterSum::record_segmented(Recorder& r, const Field& field, const SortedTexels& sorted,
                                  const LightTarget& target) {
  const uint32_t clusters = target.count;
  // Levels of pieces until no cluster can have more than kBlock.
  uint32_t levels = 1;
  for (uint64_t reach = uint64_t{kBlock} * kBlock; reach < sorted.count; reach *= kBlock) ++levels;
  // 1. Where each cluster's texels start.  2. Where its pieces do, on each level.
  const Buffer& starts = record_starts(r, field, sorted, clusters, levels + 1);
  for (uint32_t level = 1; level <= levels; ++level) {
    const struct { uint32_t clusters, level; } push{clusters, level};
    r.dispatch(*pieces_, {starts}, push, 1);
    r.barrier();
  }
  // 3. Texels of each piece.
  uint32_t bound = piece_bound(sorted.count, clusters);
  const size_t bytes = moments_bytes(context_.lobes());
  const Buffer* from = &scratch(field.half, "partials0", bound * bytes);
  const Buffer* to = &scratch(field.half, "partials1", piece_bound(bound, clusters) * bytes);
  const struct {
    gpu::Emitter emitter;
    uint32_t clusters, bound;
  } leaves{field.emitter, clusters, bound};
  dispatch_items(r, *leaves_, {field.maps, *sorted.texels, starts, *from}, leaves, bound);
  r.barrier();
  // 4. Pieces of pieces.
  for (uint32_t level = 2; level <= levels; ++level) {
    bound = piece_bound(bound, clusters);
    const struct { uint32_t clusters, bound, level; } push{clusters, bound, level};
    dispatch_items(r, *partials_, {starts, *from, *to}, push, bound);
    r.barrier();
    std::swap(from, to);
  }
  // 5. What is left of each cluster, as a light.
  const struct { uint32_t clusters, level; } last{clusters, levels};
  dispatch_items(r, *lights_, {starts, *from, *target.buffer}, last, clusters);
}

}  // namespace vsglbench
