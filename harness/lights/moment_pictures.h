// The mipmapped RSM that VSGLs are filtered from, and its picture [MFIS16 Fig. 4].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/png.h"
#include "method/context.h"

namespace vsglbench {

// A texel of one level: means over the base texels that it covers [MFIS16 App. B].
struct MomentTexel {
  glm::vec3 diffuse{0}, specular{0};  // power that each lobe reflects, W a base texel
  // E[r ξ] with r = λ/(λ+1), weighted with the luminance of the lobe's power: shorter than 1 by how much the
  // lobe spreads. Zero where the lobe has no power.
  glm::vec3 diffuse_direction{0}, specular_direction{0};
  // E[y] and E[|y|²], weighted with the luminance of both lobes' power, m and m² from the scene's origin. A
  // base texel is a square, not a point: its own variance counts.
  glm::vec3 position{0};
  double square = 0;
};

struct MomentLevel {
  uint32_t width = 0, height = 0;
  std::vector<MomentTexel> texels;  // row by row
};

struct MipmappedRsm {
  unsigned lobes = 0;               // that the lights have, as in shaders/types.h; all else is 0
  std::vector<MomentLevel> levels;  // the RSM's size first, one texel last
};

// What filtered sampling read on the device when the method of this context last made lights of an RSM of
// this size; nothing for a method that does not filter it by its mips. Paper and kernels differ in what they
// store, not in what that is: kernels keep E|y-E[y]|², from which E[|y|²] is computed here.
std::optional<MipmappedRsm> read_mipmapped_rsm(const MethodContext& context, uint32_t width, uint32_t height);

// The scene's box, m from `origin`, which is in world coordinates.
struct SceneBox {
  glm::dvec3 origin{0};
  glm::vec3 low{0}, high{1};
};

// Panels (a) to (f) of the figure: power, direction of both lobes, position, squared norm. In each, the
// finest level stands left and the coarser ones one below the other at its right. A texel is as many whole
// pixels as fit, 16 at most; levels for which there is no room are left out, and so are panels of a lobe that
// the lights do not have. The sheet is 1100 pixels wide at most. `captions` stand above, what the colours
// mean at each panel and below.
Bitmap draw_moments(const MipmappedRsm& rsm, const SceneBox& box, const std::vector<std::string>& captions);

}  // namespace vsglbench
