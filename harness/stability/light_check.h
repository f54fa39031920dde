// Lights against double precision: what they must carry, recomputed from the texels they were made from.
#pragma once

#include "conformance/lights.h"
#include "method/oracle.h"
#include "stability/cell.h"

namespace vsglbench {

// What a method was asked for.
struct LightsAsked {
  const oracle::Half& half;
  const MethodInfo& method;
  const Json& parameters;  // resolved
  glm::uvec2 shift{0};
  bool powerless = false;  // no light may have power
};

// Every record sound (conformance/lights.h), and then what has a double form:
//   filtered sampling    (LightRule) each light, of method/oracle.h at the level that the light says, which
//   must be the
//                        oracle's within two steps of the bisection; a lattice point that lies on the border
//                        of a texel may fall on either side
//   all texels in VSGLs  (flux_bound ≤ 1e-3) powers, mean directions, mean and variance of all lights
//   together, and
//                        no light's variance below the least of the texels' own
//   VPLs                 each is a texel: its position, normals and material to the bit, its direction, and
//                        by LightRule::texel its flux
// Errors are relative: powers to the light's, mean directions (r ξ) to 1, 1-r to itself, positions to σ,
// and variances to themselves; where single precision can't hold a position (2^-23 of its size) or an angle
// between two directions (2^-47 in 1-r), what it can't hold counts as 1e-3.
void check_lights(const LightsAsked& asked, const LightRecords& lights, Judgement* verdict);

// `mean` power of the lights and its standard error, both over the texels' power, against the method's
// flux_bound: a bias where it is off by more than the bound and three standard errors.
void check_energy(const MethodInfo& method, double mean, double standard_error, Judgement* verdict);

}  // namespace vsglbench
