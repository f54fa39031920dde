// How well the lights' footprints or clusters cover the RSM: overlap and gap [MFIS16 Fig. 1], and how much of
// the PDF each footprint holds [MFIS16 Eq. 2].
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "method/method.h"
#include "report/coverage.h"

namespace vsglbench {

// LightShapes on the host; both empty where the method defines none.
struct RsmShapes {
  std::vector<glm::vec4> squares;  // one a light: centre x, y and side in texels; side 0: no light
  std::vector<uint32_t> clusters;  // one a texel, row by row: its light; the number of lights or more: none
};

// Throws Error(plugin) for a square that is not finite or of negative side, and a texel outside of the RSM.
RsmShapes read_shapes(const LightShapes& shapes, uint32_t lights, uint64_t texels);

// Coverage by footprints (LightShapes::squares): each is a trilinear filter at its centre, whose mip
// level l has texels as large as its side, and its light stands for 4^l texels of the filtered mean. The
// texels that the taps read count by their weights in that; so a light of `mfis` at K = 1 counts each as
// often as it carries the texel's flux. `pdf` has any scale, row by row; it may be empty.
Coverage cover_footprints(const std::vector<glm::vec4>& footprints, uint32_t width, uint32_t height,
                          const std::vector<float>& pdf);
// What each footprint holds of the PDF, as a multiple of what [MFIS16 Eq. 2] asks for: N ∫ p g, of N
// footprints, with the weights that coverage counts. 1: as intended; of `mfis`, K. A footprint of one texel
// has N p/Σp; the mean over all is 1 + pdf_overlap - pdf_gap. One a footprint, 0 where its side is 0; none at
// all where `pdf` is empty or 0 everywhere. Takes the time of a pass over the PDF, and 8 reads a footprint.
std::vector<double> kernel_masses(const std::vector<glm::vec4>& footprints, uint32_t width, uint32_t height,
                                  const std::vector<float>& pdf);
// Over the footprints of side > 0; nothing where there is none, or no mass.
std::optional<KernelStats> kernel_stats(const std::vector<glm::vec4>& footprints,
                                        const std::vector<double>& masses);
// Both at once; nothing where the method has no footprints.
std::optional<KernelStats> kernels_of(const RsmShapes& shapes, uint32_t width, uint32_t height,
                                      const std::vector<float>& pdf);

// Coverage by a partition, which has no overlap.
Coverage cover_clusters(const std::vector<uint32_t>& clusters, uint32_t lights,
                        const std::vector<float>& pdf);

// Coverage by either; nothing where the method defines no shapes.
std::optional<Coverage> coverage_of(const RsmShapes& shapes, uint32_t lights, uint32_t width, uint32_t height,
                                    const std::vector<float>& pdf);

}  // namespace vsglbench
