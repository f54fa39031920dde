// A light cut: the leaves of a tree over position and direction, which is split where samples of the PDF are
// furthest apart.
#include <algorithm>
#include <bit>
#include <map>

#include "gpu/limits.h"
#include "method/cluster_sum.h"
#include "method/light_kernel.h"
#include "method/plugin.h"
#include "method/radix_sort.h"

namespace vsglbench {
namespace {

// Samples at least, and at most: an invocation that splits a node by itself goes through the node's samples
// three times.
constexpr uint32_t kLeastSamples = 4096, kMostSamples = limits::quarter_of_rounds;
// Rounds beyond those of a balanced tree, so that it may lean.
constexpr uint32_t kSpareRounds = 4;
// Rounds in which a workgroup splits one node: they have few. Later an invocation does.
constexpr uint32_t kHeapRounds = 8, kHeap = 1u << kHeapRounds;
constexpr uint32_t kNodes = 64;  // nodes of a workgroup then
const glm::uvec2 kBlock(4, 4);   // texels that one invocation takes down the tree

class Cut : public Method {
 public:
  Cut(MethodContext& context, float direction, float glossy, uint32_t per_light)
      : context_(context),
        direction_(direction),
        glossy_(glossy),
        per_light_(per_light),
        sort_(context),
        sum_(context, ClusterSumVariant::segmented),
        draw_(context.kernel("cut_draw.comp")),
        root_(context.kernel("cut_root.comp", wide(context))),
        split_one_(context.kernel("cut_split.comp", wide(context))),
        split_many_(context.kernel("cut_split.comp", {{"LANES", "1"}, {"NODES", fmt::format("{}", kNodes)}})),
        assign_(context.kernel("cut_assign.comp", {{"BLOCK_X", fmt::format("{}u", kBlock.x)},
                                                   {"BLOCK_Y", fmt::format("{}u", kBlock.y)}})) {}

  LightKind kind() const override { return LightKind::vsgl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    Recorder& r = steps.recorder();
    const Buffer& ids = scratch(field, "ids", field.texels() * 4);
    steps.pass("draw", [&] { draw(r, field, target); });
    steps.pass("tree", [&] { build(r, field, target); });
    steps.pass("assign", [&] { assign(r, field, target, ids); });
    ClusterSum::SortedTexels sorted;
    steps.pass("sort", [&] { sorted = sort(r, field, target.count, ids); });
    steps.pass("sum", [&] { sum_.record(r, field, sorted, target); });
    sorted_[field.half] = sorted;
  }

  LightShapes shapes(Half half) override {
    return {.ids = sorted_[half].ids, .texels = sorted_[half].texels};
  }

 private:
  static ShaderDefines wide(MethodContext& context) {
    return {{"LANES", context.device().is_cpu() ? "8" : "64"}, {"NODES", "1"}};
  }
  const Buffer& scratch(const Field& field, const char* name, size_t bytes) {
    return context_.scratch(fmt::format("cut.{}.{}", name, half_name(field.half)), bytes);
  }
  uint32_t sample_count(uint32_t lights) const {
    return static_cast<uint32_t>(
        std::clamp<uint64_t>(uint64_t{lights} * per_light_, kLeastSamples, kMostSamples));
  }
  const Buffer& space(const Field& field) { return scratch(field, "space", 20); }
  const Buffer& nodes(const Field& field, uint32_t lights) { return scratch(field, "nodes", lights * 8); }
  const Buffer& samples(const Field& field, uint32_t lights, uint32_t which) {
    return scratch(field, which ? "samples1" : "samples0", sample_count(lights) * 24);
  }

  void draw(Recorder& r, const Field& field, const LightTarget& target) {
    const uint32_t count = sample_count(target.count);
    const struct {
      gpu::Emitter emitter;
      uint32_t count, step;
      glm::uvec2 shift;
      float glossy;
    } push{field.emitter, count, lattice_step(count), target.shift, glossy_};
    r.dispatch(draw_, {field.maps, *field.pdf, samples(field, target.count, 0)}, push, groups_for(count, 64));
  }

  void build(Recorder& r, const Field& field, const LightTarget& target) {
    const uint32_t count = sample_count(target.count), parts = target.count / 2 + 1;
    const Buffer& tasks = scratch(field, "tasks", (kHeap + parts) * 24);
    r.fill(tasks, 0xffffffff);
    r.barrier();
    const struct {
      uint32_t count, lights;
      float direction;
    } root{count, target.count, direction_};
    r.dispatch(root_, {samples(field, target.count, 0), space(field), tasks}, root, 1);
    r.barrier();
    const auto rounds = static_cast<uint32_t>(std::bit_width(target.count - 1)) + kSpareRounds;
    for (uint32_t round = 0; round < rounds; ++round) {
      const bool heap = round < kHeapRounds;
      const struct {
        uint32_t first_slot, slots, round, rounds, heap_rounds;
      } push{heap ? 1u << round : kHeap, heap ? 1u << round : parts, round, rounds, kHeapRounds};
      const uint32_t groups = groups_for(push.slots, heap ? 1 : kNodes);
      r.dispatch(heap ? split_one_ : split_many_,
                 {samples(field, target.count, round % 2), samples(field, target.count, 1 - round % 2), tasks,
                  nodes(field, target.count)},
                 push, groups);
      r.barrier();
    }
  }

  void assign(Recorder& r, const Field& field, const LightTarget& target, const Buffer& ids) {
    const struct {
      gpu::Emitter emitter;
      uint32_t count;
      float direction, glossy;
    } push{field.emitter, target.count, direction_, glossy_};
    r.dispatch(assign_, {field.maps, space(field), nodes(field, target.count), ids}, push,
               groups_for(field.emitter.width, 8 * kBlock.x), groups_for(field.emitter.height, 8 * kBlock.y));
  }

  ClusterSum::SortedTexels sort(Recorder& r, const Field& field, uint32_t clusters, const Buffer& ids) {
    const size_t bytes = field.texels() * 4;
    const auto texels = static_cast<uint32_t>(field.texels());
    const auto bits = static_cast<uint32_t>(std::bit_width(clusters));  // ids 0 to N, N: no cluster
    const auto pairs = sort_.record(r, {&ids, &scratch(field, "texels", bytes)},
                                    {&scratch(field, "ids2", bytes), &scratch(field, "texels2", bytes)},
                                    texels, bits, RadixSort::Payload::index);
    return {pairs.keys, pairs.values, texels};
  }

  MethodContext& context_;
  float direction_, glossy_;
  uint32_t per_light_;
  RadixSort sort_;
  ClusterSum sum_;
  std::map<Half, ClusterSum::SortedTexels> sorted_;
  const Kernel &draw_, &root_, &split_one_, &split_many_, &assign_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{
    .summary = "a light cut: leaves of a tree over position and direction, cut by the PDF's samples",
    .source = "our own, after Walter et al. 2005, Wan et al. 1988",
    .parameters =
        {{"direction", 0.5, "what a unit normal counts, in RMS distances of the samples", 0.0, 100.0, {}},
         {"glossy",
          3.0,
          "what is added to that where all is reflected specularly, in multiples of it",
          0.0,
          100.0,
          {}},
         {"samples", 4, "samples of the PDF a light that the tree is made of", 1, 64, {}}},
    .case_defaults = {{"shading", "filtered"},
                      {"light_clearance", "sigma"},
                      {"importance_lights", 128},
                      {"importance_norm", "l2"}},
    .flux_bound = 1e-4,  // every texel is in one leaf
    .create = [](MethodContext& context, const Json& p) -> std::unique_ptr<Method> {
      return std::make_unique<Cut>(context, p.at("direction").get<float>(), p.at("glossy").get<float>(),
                                   p.at("samples").get<uint32_t>());
    }})
