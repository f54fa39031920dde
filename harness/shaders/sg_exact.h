// Spherical Gaussians in double precision on the host: what the GLSL in this folder is tested against.
// Written from the papers, not from that GLSL. Where a formula approximates an integral, the integral itself
// is here too, by adaptive quadrature.
//   G(ω;ξ,λ) = exp(λ(ω·ξ-1)), λ >= 0 its sharpness.
// Sources: [MFIS16] App. A–C, [VSGL15s], [SGL22], Banerjee et al. 2005 (vMF), Tokuyoshi et al. 2024.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace vsglbench::exact {

// expm1(x)/x, 1 at 0.
double expm1_over_x(double x);

double sg_value(const glm::dvec3& direction, const glm::dvec3& axis, double sharpness);
// A(λ) = ∫G dω = 2π(1-e^{-2λ})/λ; 4π at 0 [MFIS16 App. A].
double sg_integral(double sharpness);
// The factor of the von Mises–Fisher density G/A(κ).
double vmf_normalization(double sharpness);

// G(ω;ξ1,λ1) G(ω;ξ2,λ2) = e^{log_amplitude} G(ω;axis,sharpness). Where the two cancel, axis is ξ1.
struct SgProduct {
  glm::dvec3 axis;
  double sharpness = 0, log_amplitude = 0;
};
SgProduct sg_product(const glm::dvec3& axis1, double sharpness1, const glm::dvec3& axis2, double sharpness2);

// Toksvig's complement q = 1-r of r = λ/(λ+1), and back; Banerjee's κ = r(3-r²)/(1-r²) of r = 1-q; and 1-r of
// a vMF lobe itself, r = coth κ - 1/κ.
double toksvig_complement(double sharpness);
double toksvig_sharpness(double complement);
double banerjee_sharpness(double complement);
double vmf_complement(double sharpness);

// max(ω·z,0) exp(-ηx(ω·x)² - ηy(ω·y)²), by the components of ω in the frame (x,y,z) [VSGL15s App. B].
double asg_value(const glm::dvec3& local, double eta_x, double eta_y);
// [VSGL15s App. B]: ∫ SG × ASG ≈ π/√((ηx+ν)(ηy+ν)) Ĝ(ξ; ηxν/(ηx+ν), ηyν/(ηy+ν)), ν = λ/2, of an SG whose axis
// has these components.
double asg_product(const glm::dvec3& local_axis, double sharpness, double eta_x, double eta_y);

// By adaptive Gauss–Kronrod quadrature over the angle from v; relative error 1e-10, for cosines v·n in [-1,1]
// and κ in [0,2^41]; 0 where the result is below what a double can hold.
//   L(v,κ) = ∫G max(ω·n,0) / ∫G                                       [SGL22 §2]
double clamped_cosine(double cosine, double sharpness);
//   ∫ over the hemisphere of n of G
double hemispherical_integral(double cosine, double sharpness);
//   s(v·n,κ) = (that - B)/(A - B), A and B those for v = n and v = -n  [SGL22 §3]
double normalized_hemisphere(double cosine, double sharpness);

// The formulas for L(v,κ) that `diffuse` of a configuration names, in the order of GLSL's DIFFUSE_MODEL.
enum class DiffuseModel { cosine, pettineo_hill, meder_bruederlin, tokuyoshi2022, tokuyoshi2024 };
const std::vector<std::string>& diffuse_model_names();
// κ > 0 (pettineo-hill has no value at 0), else κ >= 0.
double diffuse_model(DiffuseModel model, double cosine, double sharpness);
// The two approximations of s(v·n,κ): Meder and Brüderlin's logistic one, and [SGL22 Eq. 1].
double logistic_hemisphere(double cosine, double sharpness);
double gaussian_hemisphere(double cosine, double sharpness);

}  // namespace vsglbench::exact
