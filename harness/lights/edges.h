// How discontinuous the geometry is that lights are filtered from: "due to filtering, larger and darker VSGLs
// are generated on discontinuous geometries" [VSGL14 Fig. 2].
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/json.h"
#include "frame/light_records.h"
#include "measure/verdict.h"
#include "shaders/types.h"

namespace vsglbench {

// The surfaces that a half shows, a texel each, row by row.
struct TexelSurfaces {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec4> positions;  // m; w > 0 where there is a surface
  std::vector<glm::vec4> normals;    // xyz: of the faces, unit
  std::vector<double> sizes;  // side of a square as large as the texel on its surface, m; 0: no surface
};
TexelSurfaces surfaces_of(const gpu::Emitter& emitter, std::vector<glm::vec4> positions,
                          std::vector<glm::vec4> normals);

// Of two texels, whether the geometry between them is discontinuous: one has no surface; or their normals are
// more than 60° apart; or one lies off the other's plane by more than two texels, the larger ones of the two.
// Where both have no surface there is no geometry, and no edge.
bool is_edge(const TexelSurfaces& half, size_t a, size_t b);

// What is under a light's square: the texels of which it holds a part.
struct FootprintEdges {
  // Of the pairs of texels there that are neighbours in a row or a column, those with no surface at all left
  // out: which part is_edge(). 0 where there is no pair.
  double share = 0;
  double texel = 0;  // median of the sizes of the texels with a surface, m; 0 where there is none
};
// `squares` as in RsmShapes: centre x, y and side in texels.
std::vector<FootprintEdges> footprint_edges(const TexelSurfaces& half, const std::vector<glm::vec4>& squares);

// Lights on edges, of edge share above kOnEdge, against those that are not. Of lights with power and σ whose
// squares are 2 texels wide or more and show a surface: a smaller one is a single texel, which has neither a
// neighbour nor a filter's width.
struct EdgeEffect {
  static constexpr double kOnEdge = 0.05;
  static constexpr uint64_t kLeast = 8;  // lights of each, or there are no ratios
  uint64_t on = 0, off = 0;
  // Medians of those on edges over medians of the others, with the 95 % intervals of a bootstrap over lights.
  // Of σ over the square's side in metres: above 1, lights on edges are larger than their squares account
  // for.
  std::optional<Ratio> sigma;
  // Of power/(2πσ²), W/m²: below 1, they are darker. It has no part in that where they were drawn: a method
  // that has large squares in the dark makes those lights darker, on edges or not.
  std::optional<Ratio> density;
};
EdgeEffect edge_effect(const LightRecords& lights, const std::vector<glm::vec4>& squares,
                       const std::vector<FootprintEdges>& edges);

// lights_on, lights_off and, where there are ratios, sigma_ratio and density_ratio, each with KEY_ci95: the
// ends of its interval.
Json to_json(const EdgeEffect& effect);
EdgeEffect edge_effect_from(const Json& json);

}  // namespace vsglbench
