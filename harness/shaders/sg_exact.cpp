#include "shaders/sg_exact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench::exact {
namespace {

using glm::dvec3;
using std::numbers::pi;

double square(double x) { return x * x; }

}  // namespace

double expm1_over_x(double x) { return x == 0 ? 1 : std::expm1(x) / x; }

double sg_value(const dvec3& direction, const dvec3& axis, double sharpness) {
  const dvec3 d = direction - axis;
  return std::exp(-0.5 * sharpness * glm::dot(d, d));
}

double sg_integral(double sharpness) { return 4 * pi * expm1_over_x(-2 * sharpness); }

double vmf_normalization(double sharpness) { return 1 / sg_integral(sharpness); }

SgProduct sg_product(const dvec3& axis1, double sharpness1, const dvec3& axis2, double sharpness2) {
  const dvec3 sum = sharpness1 * axis1 + sharpness2 * axis2, difference = axis1 - axis2;
  SgProduct p;
  p.sharpness = std::hypot(sum.x, sum.y, sum.z);
  p.axis = p.sharpness > 0 ? sum / p.sharpness : axis1;
  // λ-λ1-λ2 = (λ²-(λ1+λ2)²)/(λ+λ1+λ2), and |λ1ξ1+λ2ξ2|² = (λ1+λ2)² - λ1λ2|ξ1-ξ2|².
  const double total = p.sharpness + sharpness1 + sharpness2;
  p.log_amplitude = total > 0 ? -sharpness1 * sharpness2 * glm::dot(difference, difference) / total : 0;
  return p;
}

double toksvig_complement(double sharpness) { return 1 / (sharpness + 1); }
double toksvig_sharpness(double complement) { return (1 - complement) / complement; }

double banerjee_sharpness(double complement) {
  const double r = 1 - complement;
  return r * (3 - r * r) / (complement * (2 - complement));
}

double vmf_complement(double sharpness) {
  if (sharpness < 1e-2) {  // coth κ - 1/κ = κ/3 - κ³/45 + 2κ⁵/945 - ...
    const double k2 = square(sharpness);
    return 1 - sharpness * (1 / 3.0 - k2 * (1 / 45.0 - k2 * (2 / 945.0)));
  }
  // 1 - coth κ = -2/(e^{2κ}-1).
  return 1 / sharpness - 2 / std::expm1(2 * sharpness);
}

double asg_value(const dvec3& local, double eta_x, double eta_y) {
  return std::max(local.z, 0.0) * std::exp(-eta_x * square(local.x) - eta_y * square(local.y));
}

double asg_product(const dvec3& local_axis, double sharpness, double eta_x, double eta_y) {
  const double nu = sharpness / 2, sum_x = eta_x + nu, sum_y = eta_y + nu;
  return pi / std::sqrt(sum_x * sum_y) * asg_value(local_axis, eta_x * nu / sum_x, eta_y * nu / sum_y);
}

}  // namespace vsglbench::exact
