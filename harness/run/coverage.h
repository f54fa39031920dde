// How well the lights' kernels or clusters cover the RSM: overlap and gap [MFIS16 Fig. 1].
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

// Of an area, where c lights hold a point. overlap + gap is the mean of |c - 1|: how far the lights are from
// holding every point once.
struct Coverage {
  double overlap = 0;  // mean of max(c - 1, 0): 1 where every point has one light too many
  double gap = 0;      // share of the area with c = 0
  // The same means over points distributed as the PDF: where that is 0 nobody needs a light. Absent without
  // a PDF, or with one that is 0 everywhere.
  std::optional<double> pdf_overlap, pdf_gap;
};

// Of axis-aligned squares, clipped to `width` × `height` texels. Exact but for rounding in double precision,
// below 1e-9 for up to 2^16 squares: a scanline over the squares' own edges and the texels' rows. `pdf`: of
// any scale, constant on each texel, row by row; may be empty.
Coverage cover_squares(const std::vector<glm::vec4>& squares, uint32_t width, uint32_t height,
                       const std::vector<float>& pdf);
// Of a partition: no overlap.
Coverage cover_clusters(const std::vector<uint32_t>& clusters, uint32_t lights,
                        const std::vector<float>& pdf);

// Of either; nothing where the method defines no shapes.
std::optional<Coverage> coverage_of(const RsmShapes& shapes, uint32_t lights, uint32_t width, uint32_t height,
                                    const std::vector<float>& pdf);

}  // namespace vsglbench
