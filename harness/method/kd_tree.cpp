#include "method/kd_tree.h"

#include <bit>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr uint32_t kCodeBits = 31;  // shaders/kd_codes.comp

}  // namespace

ShaderDefines KdTree::defines(int dimensions) {
  return {{"DIMENSIONS", std::to_string(dimensions)}, {"LEAF_SIZE", fmt::format("{}u", kLeafSize)}};
}

KdTree::KdTree(MethodContext& context, int dimensions)
    : context_(context),
      bounds_(context.shared_kernel("kd_bounds.comp")),
      codes_(context.shared_kernel("kd_codes.comp", defines(dimensions))),
      sort_(context),
      build_(context.shared_kernel("kd_build.comp", defines(dimensions))),
      fit_(context.shared_kernel("kd_fit.comp", defines(dimensions))) {}

void KdTree::build(Recorder& r, const Buffer& centres, uint32_t count) {
  if (count == 0 || count > kMaxCentres) {
    throw fail(ErrorKind::case_failed, "kd-tree: {} centres are not within 1 … {}", count, kMaxCentres);
  }
  const uint32_t groups = groups_for(count, 64);
  // Named by size, so that a later and larger tree of the same frame doesn't replace what is recorded here.
  const size_t room = std::bit_ceil(count);
  const auto scratch = [&](const char* name, size_t bytes) {
    return &context_.scratch(fmt::format("kd.{}.{}", name, room), room * bytes);
  };
  const Buffer& bounds = context_.scratch("kd.bounds", 32);
  const RadixSort::Pairs pairs{scratch("codes0", 4), scratch("ids0", 4)};
  const RadixSort::Pairs spare{scratch("codes1", 4), scratch("ids1", 4)};
  const Buffer &parents = *scratch("parents", 8), &visits = *scratch("visits", 4),
               &boxes = *scratch("boxes", 48);
  nodes_ = scratch("nodes", 16);
  sorted_ = scratch("centres", 16);

  r.dispatch(bounds_, {centres, bounds}, count, 1);
  r.barrier();
  r.dispatch(codes_, {centres, bounds, *pairs.keys}, count, groups);
  r.barrier();
  const auto sorted = sort_.record(r, pairs, spare, count, kCodeBits, RadixSort::Payload::index);
  r.barrier();
  r.dispatch(build_, {centres, *sorted.keys, *sorted.values, *sorted_, *nodes_, parents, visits}, count,
             groups);
  r.barrier();
  // A path tells codes apart, then ranks.
  const struct {
    uint32_t count, depth;
  } fit{count, kCodeBits + static_cast<uint32_t>(std::bit_width(count))};
  if (count > 1) r.dispatch(fit_, {*sorted_, parents, visits, boxes, *nodes_}, fit, groups);
  r.barrier();
}

}  // namespace vsglbench
