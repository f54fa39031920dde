// Surfaces that a hard case looks at its lights from, placed once the lights are known.
#pragma once

#include <vector>

#include "conformance/lights.h"
#include "method/oracle.h"

namespace vsglbench {

// Where one light of power is.
struct LightSpot {
  glm::dvec3 position;  // m
  double sigma;         // m; 0 of a point
};
std::vector<LightSpot> light_spots(const LightRecords& lights);

// All return a half whose emitter is an eye, with 48 surfaces, from the same random numbers every time.
// Without lights they look at where the half's texels are.

// About the lights, facing any way, of all roughnesses.
oracle::Half scattered_receivers(const oracle::Half& half, const std::vector<LightSpot>& spots);
// Each at `sigmas` σ plus `metres` from one of the lights.
oracle::Half receivers_at_lights(const oracle::Half& half, const std::vector<LightSpot>& spots, double sigmas,
                                 double metres);
// Receivers of lights that lie close together, at these cosines of the direction to them and of the view with
// the normal. A negative one: the lights are behind.
oracle::Half receivers_at_angles(const oracle::Half& half, const std::vector<LightSpot>& spots,
                                 double light_cosine, double view_cosine);
// In the mirror directions of the half's texels, mirroring them to the eye but for lobe widths; their normal
// distribution is `ndf`.
oracle::Half glossy_receivers(const oracle::Half& half, const std::vector<LightSpot>& spots, float ndf);

}  // namespace vsglbench
