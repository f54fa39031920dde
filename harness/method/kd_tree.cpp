#include "method/kd_tree.h"

#include <bit>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr uint32_t kCodeBits = 31;  // shaders/kd_codes.comp: 30, and what is no centre

}  // namespace

ShaderDefines KdTree::defines(int dimensions) {
  return {{"DIMENSIONS", std::to_string(dimensions)}, {"LEAF_SIZE", fmt::format("{}u", kLeafSize)}};
}

KdTree::KdTree(MethodContext& context, int dimensions)
    : context_(context),
      few_(context.shared_kernel("kd_small.comp", defines(dimensions))),
      bounds_(context.shared_kernel("kd_bounds.comp")),
      codes_(context.shared_kernel("kd_codes.comp", defines(dimensions))),
      sort_(context),
      build_(context.shared_kernel("kd_build.comp", defines(dimensions))),
      fit_(context.shared_kernel("kd_fit.comp", defines(dimensions))) {}

void KdTree::build(Recorder& r, const Buffer& centres, uint32_t count) {
  if (count == 0 || count > kMaxCentres) {
    throw fail(ErrorKind::case_failed, "kd-tree: {} centres are not within 1 … {}", count, kMaxCentres);
  }
  nodes_ = &scratch("nodes", count, 16);
  sorted_ = &scratch("centres", count, 16);
  if (count <= kFewCentres) {
    build_few(r, centres, count);
  } else {
    build_many(r, centres, count);
  }
}

const Buffer& KdTree::scratch(const char* name, uint32_t count, size_t bytes_each) {
  const size_t room = std::bit_ceil(count);
  return context_.scratch(fmt::format("kd.{}.{}", name, room), room * bytes_each);
}

void KdTree::build_few(Recorder& r, const Buffer& centres, uint32_t count) {
  r.dispatch(few_,
             {centres, *sorted_, *nodes_, scratch("words", count, 16), scratch("node boxes", count, 24)},
             count, 1);
  r.barrier();
}

void KdTree::build_many(Recorder& r, const Buffer& centres, uint32_t count) {
  const uint32_t groups = groups_for(count, 64);
  const Buffer& bounds = context_.scratch("kd.bounds", 32);
  const RadixSort::Pairs pairs{&scratch("codes0", count, 4), &scratch("ids0", count, 4)};
  const RadixSort::Pairs spare{&scratch("codes1", count, 4), &scratch("ids1", count, 4)};
  const Buffer &parents = scratch("parents", count, 8), &visits = scratch("visits", count, 4),
               &boxes = scratch("boxes", count, 48);

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
  r.dispatch(fit_, {*sorted_, parents, visits, boxes, *nodes_}, fit, groups);
  r.barrier();
}

}  // namespace vsglbench
