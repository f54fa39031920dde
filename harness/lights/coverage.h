// How well the lights' footprints or clusters cover the RSM: overlap and gap [MFIS16 Fig. 1].
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "method/method.h"

namespace vsglbench {

// LightShapes on the host; both empty where the method defines none.
struct RsmShapes {
  std::vector<glm::vec4> squares;  // one a light: centre x, y and side in texels; side 0: no light
  std::vector<uint32_t> clusters;  // one a texel, row by row: its light; the number of lights or more: none
};

// Throws Error(plugin) for a square that is not finite or of negative side, and a texel outside of the RSM.
RsmShapes read_shapes(const LightShapes& shapes, uint32_t lights, uint64_t texels);

// How evenly lights hold an area, of which c lights hold each texel, whole or in part. overlap + gap is the
// mean of |c - 1|: how far the lights are from holding every texel once.
struct Coverage {
  double overlap = 0;  // mean of max(c - 1, 0): 1 where every texel has one light too many
  double gap = 0;      // mean of max(1 - c, 0): 1 where no texel has one
  // The same means over texels distributed as the PDF: where that is 0 nobody needs a light. Absent without
  // a PDF, or with one that is 0 everywhere.
  std::optional<double> pdf_overlap, pdf_gap;
};

// Coverage by footprints (LightShapes::squares): each is a trilinear filter at its centre, whose mip
// level l has texels as large as its side, and its light stands for 4^l texels of the filtered mean. The
// texels that the taps read count by their weights in that; so a light of `mfis` at K = 1 counts each as
// often as it carries the texel's flux. `pdf` has any scale, row by row; it may be empty.
Coverage cover_footprints(const std::vector<glm::vec4>& footprints, uint32_t width, uint32_t height,
                          const std::vector<float>& pdf);
// Coverage by a partition, which has no overlap.
Coverage cover_clusters(const std::vector<uint32_t>& clusters, uint32_t lights,
                        const std::vector<float>& pdf);

// Coverage by either; nothing where the method defines no shapes.
std::optional<Coverage> coverage_of(const RsmShapes& shapes, uint32_t lights, uint32_t width, uint32_t height,
                                    const std::vector<float>& pdf);

}  // namespace vsglbench
