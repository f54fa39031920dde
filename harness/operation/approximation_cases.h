// Surfaces and lights that the oracles of approximations.h share: the receiver at the origin, in a frame that
// no coordinate plane favours, the light 1 m away in the mirror direction.
#pragma once

#include <string>

#include "operation/shading_probe.h"
#include "shaders/shading_exact.h"

namespace vsglbench::approximation {

double radians(double degrees);

// Viewer and light at `angle` rad from the normal in one plane; unit.
glm::dvec3 normal();
glm::dvec3 view_at(double angle);
glm::dvec3 way_at(double angle);
// Away from the normal in that plane, perpendicular to way_at(); and perpendicular to the plane.
glm::dvec3 away_at(double angle);
glm::dvec3 across();

struct Material {
  std::string name;
  float albedo, f0, ndf;
};
inline const Material kLambert{"Lambert", 0.5f, 0, 1}, kPhong{"Phong 300", 0, 1, -300},
    kMixed{"Lambert + GGX 0.3", 0.5f, 0.04f, 0.3f}, kRough{"GGX 0.3", 0, 1, 0.3f};

// A surface of this material at the origin under 1 W, seen or lit from `towards`.
gpu::Vpl record_of(const Material& material, const glm::dvec3& normal, const glm::dvec3& towards);

// The VSGL has no intensity yet; its lobes' axes point at the surface.
ShadingPair mirror_pair(const Material& receiver, double angle, double sigma);
// The texel at the light's mean, lit from 40° beside the way to the surface, its normal 2° off the half
// vector in both planes.
void set_texel(const Material& emitter, double angle, ShadingPair* pair);

}  // namespace vsglbench::approximation
