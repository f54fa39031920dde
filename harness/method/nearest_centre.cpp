#include "method/nearest_centre.h"

#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

ShaderDefines search_defines(int dimensions, glm::uvec2 block) {
  ShaderDefines defines = KdTree::defines(dimensions);
  defines.insert({{"BLOCK_X", fmt::format("{}u", block.x)}, {"BLOCK_Y", fmt::format("{}u", block.y)}});
  return defines;
}

}  // namespace

// On lavapipe 8 × 4 takes 0.7 to 0.9 of the time of 4 × 4; 8 × 8 takes more than twice as long. On an H200 an
// RSM of 512² is too few blocks of 8 × 4 to fill it: 0.37 to 1.6 ms, texel by texel 0.26 to 0.31
// (reports/h200).
glm::uvec2 choose_search_block(NearestCentre::Search search, const DeviceInfo& info) {
  const bool together = search == NearestCentre::Search::tiles && info.type == "cpu";
  return together ? glm::uvec2(8, 4) : glm::uvec2(1, 1);
}

CentreSampler::CentreSampler(MethodContext& context, int dimensions)
    : kernel_(context.shared_kernel("centres.comp", {{"DIMENSIONS", std::to_string(dimensions)}})) {}

void CentreSampler::record(Recorder& r, const Field& field, glm::uvec2 shift, const Buffer& centres,
                           uint32_t count) {
  const struct {
    uint32_t width, height, count, step;
    glm::uvec2 shift;
  } push{field.emitter.width, field.emitter.height, count, lattice_step(count), shift};
  r.dispatch(kernel_, {*field.maps.position, *field.pdf, centres}, push, groups_for(count, 64));
  r.barrier();
}

NearestCentre::NearestCentre(MethodContext& context, int dimensions, Search search)
    : tree_(context, dimensions),
      block_(choose_search_block(search, context.device().info())),
      search_(context.shared_kernel("nearest_centre.comp", search_defines(dimensions, block_))) {}

void NearestCentre::record(Recorder& r, const Field& field, const Buffer& centres, uint32_t count,
                           const Buffer& ids) {
  tree_.build(r, centres, count);
  const glm::uvec2 size(field.emitter.width, field.emitter.height);
  const struct { uint32_t width, height, count; } push{size.x, size.y, count};
  r.dispatch(search_, {*field.maps.position, tree_.nodes(), tree_.centres(), ids}, push,
             groups_for(size.x, 8 * block_.x), groups_for(size.y, 8 * block_.y));
  r.barrier();
}

}  // namespace vsglbench
