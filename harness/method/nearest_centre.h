// The nearest cluster centre of every texel of a half, as k-means clustering needs it [MFIS16 App. D].
#pragma once

#include "method/kd_tree.h"
#include "method/method.h"

namespace vsglbench {

// Cluster centres by warping the PDF, exactly where fis and mfis place their kernels. `centres` gets `count`
// vec4: 2-D, the chosen texel's centre in texels, z = 0; 3-D, its position in metres. w > 0: there is a
// centre; none is where the PDF is zero everywhere or, in 3-D, where the chosen texel has no surface.
class CentreSampler {
 public:
  CentreSampler(MethodContext& context, int dimensions);
  // In the recorder's current pass, with a barrier at the end.
  void record(Recorder& recorder, const Field& field, glm::uvec2 shift, const Buffer& centres,
              uint32_t count);

 private:
  const Kernel& kernel_;
};

class NearestCentre {
 public:
  enum class Search {
    kd_tree,  // every texel by itself, as the paper does
    tiles     // blocks of neighbouring texels together, where that pays (choose_search_block)
  };
  // `dimensions`: 2, between texel centres in the image, in texels; 3, between positions, in metres.
  NearestCentre(MethodContext& context, int dimensions, Search search);
  // Writes the id of the nearest centre of each texel to `ids`, row-major words; of equally near ones (in
  // single precision) the least, the same in both searches. `count` where the texel has no surface or there
  // is no centre at all. `centres`: as CentreSampler makes them. In the recorder's current pass, with
  // barriers inside and at the end.
  void record(Recorder& recorder, const Field& field, const Buffer& centres, uint32_t count,
              const Buffer& ids);

 private:
  KdTree tree_;
  glm::uvec2 block_;
  const Kernel& search_;
};

// Texels that one invocation searches for together, along x and y. `tiles` blocks where few invocations run
// at a time (a CPU); a GPU has more invocations than a half has blocks, and searches for every texel by
// itself.
glm::uvec2 choose_search_block(NearestCentre::Search search, const DeviceInfo& info);

}  // namespace vsglbench
