#include "method/kmeans.h"

#include <bit>
#include <map>

#include "gpu/limits.h"

namespace vsglbench {
namespace {

class KMeans : public Method {
 public:
  KMeans(MethodContext& context, const KMeansParameters& p)
      : context_(context),
        iterations_(p.iterations),
        centres_(context, p.dimensions),
        nearest_(context, p.dimensions, p.search),
        sort_(context),
        sum_(context, p.sum) {
    if (iterations_ > 0) {
      move_ = &context.shared_kernel("kmeans_move.comp", {{"DIMENSIONS", std::to_string(p.dimensions)}});
    }
  }

  LightKind kind() const override { return LightKind::vsgl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    Recorder& r = steps.recorder();
    const Buffer& centres = scratch(field, "centres", target.count * sizeof(glm::vec4));
    ClusterSum::SortedTexels sorted;
    // 1. Centres by warping the PDF.  2. Each texel to its nearest centre.  3. Texels by cluster.
    steps.pass("assign", [&] {
      centres_.record(r, field, target.shift, centres, target.count);
      nearest_.record(r, field, centres, target.count, ids(field));
    });
    steps.pass("sort", [&] { sorted = sort(r, field, target.count); });
    // Unlike the paper, which does not iterate: Lloyd's steps, where they are asked for.
    for (uint32_t i = 0; i < iterations_; ++i) {
      steps.pass("move", [&] { move(r, field, sorted, centres, target.count); });
      steps.pass("assign", [&] { nearest_.record(r, field, centres, target.count, ids(field)); });
      steps.pass("sort", [&] { sorted = sort(r, field, target.count); });
    }
    // 4. Each cluster's total.
    steps.pass("sum", [&] { sum_.record(r, field, sorted, target); });
    sorted_[field.half] = sorted;
  }

  LightShapes shapes(Half half) override {
    return {.ids = sorted_[half].ids, .texels = sorted_[half].texels};
  }

 private:
  const Buffer& scratch(const Field& field, const char* name, size_t bytes) {
    return context_.scratch(fmt::format("kmeans.{}.{}", name, half_name(field.half)), bytes);
  }
  const Buffer& ids(const Field& field) { return scratch(field, "ids", field.texels() * 4); }

  ClusterSum::SortedTexels sort(Recorder& r, const Field& field, uint32_t clusters) {
    const size_t bytes = field.texels() * 4;
    const auto texels = static_cast<uint32_t>(field.texels());
    const auto bits = static_cast<uint32_t>(std::bit_width(clusters));  // ids 0 to N, N: no cluster
    const auto pairs = sort_.record(r, {&ids(field), &scratch(field, "texels", bytes)},
                                    {&scratch(field, "ids2", bytes), &scratch(field, "texels2", bytes)},
                                    texels, bits, RadixSort::Payload::index);
    return {pairs.keys, pairs.values, texels};
  }

  void move(Recorder& r, const Field& field, const ClusterSum::SortedTexels& sorted, const Buffer& centres,
            uint32_t count) {
    // A cluster that would use up limits::loop_rounds takes several dispatches.
    constexpr uint32_t most = (limits::loop_rounds + 1) / 2;
    const Buffer& sums = scratch(field, "sums", count * sizeof(glm::vec4));
    const uint32_t rounds = groups_for(sorted.count, most);
    for (uint32_t round = 0; round < rounds; ++round) {
      const struct {
        uint32_t width, texels, count, round, rounds, most;
      } push{field.emitter.width, sorted.count, count, round, rounds, most};
      r.dispatch(*move_, {*field.maps.position, *sorted.ids, *sorted.texels, *field.pdf, centres, sums}, push,
                 groups_for(count, 64));
      r.barrier();
    }
  }

  MethodContext& context_;
  uint32_t iterations_;
  CentreSampler centres_;
  NearestCentre nearest_;
  RadixSort sort_;
  ClusterSum sum_;
  const Kernel* move_ = nullptr;
  std::map<Half, ClusterSum::SortedTexels> sorted_;
};

}  // namespace

std::unique_ptr<Method> make_kmeans(MethodContext& context, const KMeansParameters& parameters) {
  return std::make_unique<KMeans>(context, parameters);
}

ParameterInfo lloyd_iterations() {
  return {"iterations", 0, "Lloyd's steps; the paper makes none", 0, 100, {}};
}

}  // namespace vsglbench
