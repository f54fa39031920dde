// The published formulas for L(v,κ) of sg_exact.h, in double precision.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/sg_exact.h"

namespace vsglbench::exact {
namespace {

using glm::dvec3;
using std::numbers::pi;

// Pettineo and Hill 2016: irradiance ≈ (s y + b) 2π/λ, here over A(λ).
double pettineo_hill(double cosine, double sharpness) {
  const double c0 = 0.36, c1 = 1 / (4 * c0);
  const double e1 = std::exp(-sharpness), e2 = std::exp(-2 * sharpness);
  const double scale = 1 + 2 * e2 - 1 / sharpness, bias = (e1 - e2) / sharpness - e2;
  const double x = std::sqrt(1 - scale), x0 = c0 * cosine, x1 = c1 * x;
  const double y = std::abs(x0) <= x1 ? (x0 + x1) * (x0 + x1) / x : std::clamp(cosine, 0.0, 1.0);
  return (scale * y + bias) / -std::expm1(-2 * sharpness);
}

// ∫ over the hemisphere of n of the SG (cosine, κ), from s(v·n,κ), over A(κ).
double upper_part(double s, double sharpness) {
  const double e = std::exp(-sharpness);
  return (s + e * (1 - s)) / (1 + e);  // A(κ)+B(κ) is the whole integral
}

// α-multiple of G(ω;n,λ)H, minus β-multiple of H, against the vMF lobe (cosine, κ).
template <class Hemisphere>
double sg_cosine(double cosine, double sharpness, double lambda, double mu, double alpha, Hemisphere s) {
  const dvec3 v(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine), n(0, 0, 1);
  const SgProduct p = sg_product(v, sharpness, n, lambda);
  const double product = std::exp(p.log_amplitude) * sg_integral(p.sharpness) / sg_integral(sharpness) *
                         upper_part(s(p.axis.z, p.sharpness), p.sharpness);
  return mu * product - alpha * upper_part(s(cosine, sharpness), sharpness);
}

// Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting",
// supplemental.
double tokuyoshi2024(double c, double k) {
  const double a = 2.7360831611272558, b = 17.02129778187174187535, d = 4.0100826728510421404,
               e = 15.219156263147210595, f = 76.087896272360737271;
  const double t = k * std::sqrt(0.5 * ((k + a) * k + b) / (((k + d) * k + e) * k + f));
  const double x = t * t * (c * c - 1);
  const double planar =
      0.5 * (c * std::erfc(-t * c) + std::erfc(t)) -
      std::exp(-t * t * c * c) * x * expm1_over_x(x) / (2 * std::sqrt(pi) * (t > 0 ? t : 1));
  // Σ (-κ)^j/(j+2)! and e^{-κ} Σ κ^j (-1)^j (1/(j+1)! - 1/(j+2)!): the two hemispheres of v, over 2π.
  double upper = (1 - expm1_over_x(-k)) / k;
  double lower = std::exp(-k) * (expm1_over_x(-k) - std::exp(-k)) / k;
  if (k < 0.5) {
    upper = lower = 0;
    double power = 1, factorial = 1;
    for (int j = 0; j < 16; ++j, power *= -k) {
      factorial *= j + 1;  // (j+1)!
      upper += power / (factorial * (j + 2));
      lower += power / factorial * (1 - 1.0 / (j + 2));
    }
    lower *= std::exp(-k);
  }
  return (lower + std::clamp(planar, 0.0, 1.0) * (upper - lower)) / (2 * expm1_over_x(-2 * k));
}

}  // namespace

const std::vector<std::string>& diffuse_model_names() {
  static const std::vector<std::string> names = {"cosine", "pettineo-hill", "meder-bruederlin",
                                                 "tokuyoshi2022", "tokuyoshi2024"};
  return names;
}

// (e^t e^{tc} - 1) / ((e^t - 1)(e^{tc} + 1)), over e^{t(1+max(c,0))} above and below.
double logistic_hemisphere(double cosine, double sharpness) {
  const double k = sharpness;
  const double t = std::sqrt(k) * (1.6988 * k * k + 10.8438 * k) / (k * k + 6.2201 * k + 10.2415);
  const double numerator = (1 + cosine) * expm1_over_x(-t * (1 + cosine));
  return numerator / expm1_over_x(-t) * std::exp(std::min(t * cosine, 0.0)) /
         (1 + std::exp(-t * std::abs(cosine)));
}

double gaussian_hemisphere(double cosine, double sharpness) {
  const double k = sharpness;
  const double t =
      k * std::sqrt((0.5 * k + 0.65173288269070562) / (k * k + 1.3418280033141288 * k + 7.2216687798956709));
  return t > 0 ? 0.5 + 0.5 * std::erf(t * cosine) / std::erf(t) : 0.5 + 0.5 * cosine;
}

double diffuse_model(DiffuseModel model, double cosine, double sharpness) {
  switch (model) {
    case DiffuseModel::cosine:
      return std::max(cosine, 0.0);
    case DiffuseModel::pettineo_hill:
      return pettineo_hill(cosine, sharpness);
    case DiffuseModel::meder_bruederlin:
      return sg_cosine(cosine, sharpness, 0.0315, 32.7080, 31.7003, logistic_hemisphere);
    case DiffuseModel::tokuyoshi2022: {
      const double lambda = 0.00084560872241480124;
      // 2(e^λ-1-λ) = λ² + λ³/3 + λ⁴/12 + ...: the paper prints 2e^λ-2-λ.
      const double alpha = 1 / (lambda * (1 + lambda / 3 * (1 + lambda / 4 * (1 + lambda / 5))));
      return sg_cosine(cosine, sharpness, lambda, alpha * std::exp(lambda), alpha, gaussian_hemisphere);
    }
    case DiffuseModel::tokuyoshi2024:
      return tokuyoshi2024(cosine, sharpness);
  }
  return 0;
}

}  // namespace vsglbench::exact
