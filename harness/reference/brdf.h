// The material model, exactly: Lambert + one microfacet lobe, its sampling and its densities. Single
// precision throughout: every form below keeps its digits for alpha = 1e-3 and exponents up to 1e7.
//
//   f(l, v) = Rd/pi + D(h) V(l, v) F(l.h)   where n.l > 0, n.v > 0 and g.l > 0, else 0
//     n shading normal, g geometric normal, h = (l + v)/|l + v|
//   F  Schlick 1994 with F90 = min(1, 50 max F0) (Lagarde and de Rousiers 2014 §3.1.1)
//   D  GGX (Walter et al. 2007 §5.2), or Phong normalised over projected microfacets, (e+2)/2pi (n.h)^e
//   V  height-correlated Smith for GGX (Heitz 2014 §5.2); Phong borrows it with alpha = sqrt(2/(e+2))
#pragma once

#include <glm/glm.hpp>
#include <numbers>

#include "scene/surface.h"

namespace vsglbench {

struct BrdfValue {
  glm::vec3 f{0};  // 1/sr
  float pdf = 0;   // of Brdf::sample choosing this direction, 1/sr
};

// One surface, seen from one direction.
class Brdf {
 public:
  Brdf() = default;
  // `to_viewer`: unit, away from the surface.
  Brdf(const Surface& surface, const glm::vec3& to_viewer);

  // f and the density of sample() at the unit direction `l`; both 0 where f's conditions fail.
  BrdfValue evaluate(const glm::vec3& l) const {
    BrdfValue value;
    const float nl = glm::dot(n_, l);
    if (!(nl > 0 && nv_ > 0 && glm::dot(g_, l) > 0)) return value;
    value.f = lambert_;
    value.pdf = diffuse_probability_ * nl * std::numbers::inv_pi_v<float>;
    if (f90_ > 0) add_microfacet(l, nl, &value);
    return value;
  }
  glm::vec3 f(const glm::vec3& l) const { return evaluate(l).f; }

  // A direction with density pdf(l): a cosine-weighted one with probability diffuse_probability(), else
  // the viewer mirrored at a half vector of density D(h) n.h. Nothing when that gives no direction (the
  // viewer is behind the microfacet). The direction may still fail f's conditions.
  bool sample(const glm::vec3& random, glm::vec3* direction) const;

  // Density of sample() over the whole sphere, f's conditions aside. Integrates to 1 less the chance of
  // sample() failing.
  float pdf(const glm::vec3& l) const;

  float diffuse_probability() const { return diffuse_probability_; }
  const glm::vec3& normal() const { return n_; }
  const glm::vec3& geometric_normal() const { return g_; }
  const glm::vec3& to_viewer() const { return v_; }

  // A lobe of alpha below 1/4 (Phong: exponent above 30): so sharp that only sampling it finds its
  // directions.
  bool is_sharp() const { return alpha2_ < 1.0f / 16 && f90_ > 0; }
  // Chance that sample() takes a sharp lobe.
  float sharpness() const { return is_sharp() ? 1 - diffuse_probability_ : 0; }

 private:
  struct Half {
    float vh = 0, nh = 0, d = 0;  // d: D(h)
  };
  Half half_vector(const glm::vec3& l) const;
  void add_microfacet(const glm::vec3& l, float nl, BrdfValue* value) const;
  float ndf(float nh, float sin2) const;
  float microfacet_pdf(const Half& half) const;

  glm::vec3 n_{0, 0, 1}, g_{0, 0, 1}, v_{0, 0, 1};
  glm::vec3 lambert_{0};  // Rd/pi
  glm::vec3 f0_{0};
  float f90_ = 0;
  float ndf_ = 1;            // as Surface::ndf
  float alpha2_ = 1;         // of V
  float normalization_ = 0;  // of D
  float nv_ = 1, smith_v_ = 1;
  float diffuse_probability_ = 1;
};

// Orthonormal tangents of a unit vector (Duff et al. 2017).
void tangent_frame(const glm::vec3& n, glm::vec3* x, glm::vec3* y);

}  // namespace vsglbench
