#include "shaders/shading_exact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench::exact {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr double kLeastViewCosine = 0.01, kLeastDistance2 = 1e-20, kLeastVariance = 0x1p-41;

double square(double x) { return x * x; }

// Schlick's, with f90 = min(1, 50 max f0).
dvec3 fresnel(const dvec3& f0, double cosine) {
  const double f90 = std::min(1.0, 50 * std::max({f0.x, f0.y, f0.z}));
  return f0 + (dvec3(f90) - f0) * std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5);
}

// G2/(4 nl nv), height-correlated, by Heitz's Λ.
double smith(double nl, double nv, double alpha) {
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + square(alpha) * (1 / (c * c) - 1)) - 1); };
  return nl > 0 && nv > 0 ? 1 / ((1 + lambda(nl) + lambda(nv)) * 4 * nl * nv) : 0;
}

// Phong's α is Walter et al.'s √(2/(n+2)).
double masking_alpha(double ndf) { return ndf > 0 ? ndf : std::sqrt(2 / (2 - ndf)); }
// The normal distribution as an SG: its sharpness, GGX 2/α², Phong n, and its peak [VSGL15s App. A].
double ndf_sharpness(double ndf) { return ndf > 0 ? 2 / square(ndf) : -ndf; }
double ndf_peak(double ndf) { return ndf > 0 ? 1 / (pi * square(ndf)) : (2 - ndf) / (2 * pi); }

double ndf_value(double ndf, const dvec3& n, const dvec3& h) {
  const dvec3 x = glm::cross(n, h);
  const double sine2 = std::min(glm::dot(x, x), 1.0);
  if (ndf > 0) return square(ndf) / (pi * square(sine2 + square(ndf) * (1 - sine2)));
  return ndf_peak(ndf) * std::exp(-0.5 * ndf * std::log1p(-sine2));
}

dvec3 unit_or(const dvec3& v, const dvec3& fallback) {
  const double length = glm::length(v);
  return length > 1e-15 ? v / length : fallback;
}

// The receiver's specular lobe as an ASG about the mirror direction z, x in the plane of incidence
// [MFIS16 App. C.2].
struct Lobe {
  explicit Lobe(const Surface& s) : nv(std::max(glm::dot(s.normal, s.view), kLeastViewCosine)) {
    const dvec3 any = std::abs(s.normal.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    z = 2 * glm::dot(s.view, s.normal) * s.normal - s.view;
    y = unit_or(glm::cross(s.normal, s.view), glm::normalize(glm::cross(s.normal, any)));
    x = glm::cross(y, z);
    eta_x = ndf_sharpness(s.ndf) / (8 * square(nv));
    eta_y = ndf_sharpness(s.ndf) / 8;
  }
  double nv;
  dvec3 x, y, z;
  double eta_x, eta_y;
};

double clamped_cosine_by(const VsglShading& shading, double cosine, double sharpness) {
  const bool hill = shading.diffuse == DiffuseKernel::pettineo_hill;
  if (shading.quadrature) return clamped_cosine(cosine, sharpness);
  if (hill) return diffuse_kernel(shading.diffuse, cosine, std::max(sharpness, 1e-6));
  return std::clamp(diffuse_kernel(shading.diffuse, cosine, sharpness), 0.0, 1.0);
}

// Reflected radiance per unit amplitude of incoming radiance G(ω;ξ,λ).
dvec3 shade_sg(const Surface& s, const Lobe& lobe, const dvec3& axis, double sharpness,
               const VsglShading& shading) {
  const double nl = std::clamp(glm::dot(axis, s.normal), -1.0, 1.0);
  const dvec3 diffuse = s.diffuse / pi * sg_integral(sharpness) * clamped_cosine_by(shading, nl, sharpness);
  // C(ξ) = peak · V · F · n·l, pulled out of the integral.
  const dvec3 local(glm::dot(axis, lobe.x), glm::dot(axis, lobe.y), glm::dot(axis, lobe.z));
  const double integral = asg_product(local, sharpness, lobe.eta_x, lobe.eta_y);
  const double half = 0.5 * glm::length(axis + s.view);  // cosine of the half angle
  const double cosine = std::max(nl, 0.0);
  const double factor = ndf_peak(s.ndf) * smith(cosine, lobe.nv, masking_alpha(s.ndf)) * cosine;
  return diffuse + fresnel(s.f0, half) * (factor * integral);
}

}  // namespace

dvec3 brdf_cosine(const Surface& s, const dvec3& l) {
  const double nl = glm::dot(s.normal, l), nv = glm::dot(s.normal, s.view);
  if (nl <= 0 || nv <= 0 || glm::dot(s.geometric_normal, l) <= 0) return dvec3(0);
  const dvec3 h = unit_or(l + s.view, s.normal);
  const double specular = ndf_value(s.ndf, s.normal, h) * smith(nl, nv, masking_alpha(s.ndf));
  return (s.diffuse / pi + specular * fresnel(s.f0, glm::dot(l, h))) * nl;
}

dvec3 shade_vsgl(const Surface& s, const gpu::Vsgl& light, const VsglShading& shading) {
  if (light.power <= 0) return dvec3(0);
  const dvec3 to_mean = dvec3(light.mean) - s.position;
  const double distance2 = std::max(glm::dot(to_mean, to_mean), kLeastDistance2);
  const dvec3 direction = to_mean / std::sqrt(distance2);
  const double variance =
      std::max((shading.disk ? 0.5 : 1) * static_cast<double>(light.variance), distance2 * kLeastVariance);
  const double sharpness = distance2 / variance;  // λ_σ, Eq. (11)
  const Lobe receiver(s);
  dvec3 sum(0);
  const auto add = [&](const dvec3& intensity, const dvec3& axis, double lobe_sharpness) {
    const SgProduct p = sg_product(direction, sharpness, -axis, lobe_sharpness);
    const dvec3 amplitude = intensity / (2 * pi * variance) * std::exp(p.log_amplitude);  // Eq. (12)
    sum += amplitude * shade_sg(s, receiver, p.axis, p.sharpness, shading);
  };
  add(light.diffuse, light.diffuse_axis, light.diffuse_sharpness);
  add(light.specular, light.specular_axis, light.specular_sharpness);
  return sum;
}

dvec3 shade_vpl(const Surface& s, const gpu::Vpl& light) {
  const dvec3 to_light = dvec3(light.position) - s.position;
  const double distance2 = glm::dot(to_light, to_light);
  if (light.power <= 0 || distance2 <= 0) return dvec3(0);
  const dvec3 direction = to_light / std::sqrt(distance2);
  const Surface emitter{light.position, light.normal, light.geometric_normal, light.incident, light.diffuse,
                        light.f0,       light.ndf};
  return dvec3(light.flux) * brdf_cosine(emitter, -direction) * brdf_cosine(s, direction) / distance2;
}

}  // namespace vsglbench::exact
