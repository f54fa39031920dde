// A case's lights as a reader outside of the programme wants them: JSON or CSV.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "frame/light_records.h"
#include "lights/coverage.h"
#include "lights/edges.h"

namespace vsglbench {

// All that one case made on the RSM, read back.
struct LightSet {
  LightRecords lights;
  uint32_t rsm = 0;  // texels a side
  RsmShapes shapes;
  std::vector<FootprintEdges> edges;  // one a light; empty where the method has no square footprints
  std::vector<float> pdf;  // on the RSM, of any scale, row by row; empty where the method uses none

  uint32_t count() const { return static_cast<uint32_t>(lights.count()); }
  uint64_t empty() const { return count_without_power(lights); }
};

// One object a light of power above 0, in the order of the method; positions are world coordinates in double,
// `origin` plus the light's offset; vectors are arrays of three. Floats are written with the fewest digits
// that read back as the same float.
//   VSGL      index, mean, sigma (m, √E|y-μ|²), power (luminance of the reflected power, W), level (of its
//             footprint in the mip pyramid, where it has one), diffuse and specular: axis, sharpness,
//             amplitude (RGB, W/sr) of each lobe
//   VPL, VSL  index, position, power (luminance of the incident flux, W), flux (incident, RGB, W), incident
//             (unit, towards the primary light), normal, geometric_normal, brdf: diffuse and f0 (RGB), ndf
//             ("ggx" with alpha, "phong" with exponent, "none"); radius (m, of a VSL); clamp (1/m², where
//             set)
//   both      footprint: x, y (centre) and side in texels of the RSM, for methods that have square
//   footprints, and edge_share (FootprintEdges::share);
//             mass: what it holds of the PDF, as kernel_masses(), where there is one
Json light_list(const LightSet& lights, const glm::dvec3& origin);

// The same as a table, a row a light: nested keys are joined by dots, "diffuse.axis.0".
std::string to_csv(const Json& list);

}  // namespace vsglbench
