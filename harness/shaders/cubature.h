// Integrals over a cone of directions by adaptive cubature in double precision (Genz and Malik 1980).
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

namespace vsglbench::exact {

struct Integral {
  glm::dvec3 value{0};
  double error = 0;  // bound on |error| as the rule sees it
};

// All directions within `half_angle` of `axis`, up to π: the whole sphere. Throws nothing; `axis` is unit.
struct Cone {
  glm::dvec3 axis;
  double half_angle = 0;  // rad
};

// Where an integrand is large, and the lesser width that it has there.
struct Peak {
  glm::dvec3 direction;
  double width = 0;  // rad
};

// ∫f(ω) dω over the cone to `relative_error`, or as near as 200 thousand evaluations come. A peak of `peaks`
// is not missed however narrow it is.
Integral integrate(const Cone& cone, std::span<const Peak> peaks, double relative_error,
                   const std::function<glm::dvec3(const glm::dvec3&)>& f);

// `v` made unit; `fallback` where it has no length.
glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback);

}  // namespace vsglbench::exact
