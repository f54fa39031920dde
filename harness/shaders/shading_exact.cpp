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

dvec3 reflect(const dvec3& view, const dvec3& n) { return 2 * glm::dot(view, n) * n - view; }

// The receiver's specular lobe as an ASG about the mirror direction z, x in the plane of incidence
// [MFIS16 App. C.2].
struct Lobe {
  explicit Lobe(const Surface& s) : nv(std::max(glm::dot(s.normal, s.view), kLeastViewCosine)) {
    const dvec3 any = std::abs(s.normal.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    z = reflect(s.view, s.normal);
    y = unit_or(glm::cross(s.normal, s.view), glm::normalize(glm::cross(s.normal, any)));
    x = glm::cross(y, z);
    eta_x = ndf_sharpness(s.ndf) / 8;
    eta_y = ndf_sharpness(s.ndf) / (8 * square(nv));
  }
  double nv;
  dvec3 x, y, z;
  double eta_x, eta_y;
};

double clamped_cosine_by(const VsglShading& shading, double cosine, double sharpness) {
  const bool hill = shading.diffuse == DiffuseModel::pettineo_hill;
  if (shading.quadrature) return clamped_cosine(cosine, sharpness);
  if (hill) return diffuse_model(shading.diffuse, cosine, std::max(sharpness, 1e-6));
  return std::clamp(diffuse_model(shading.diffuse, cosine, sharpness), 0.0, 1.0);
}

// The specular lobe's part of ∫ f G(ω;ξ,λ) cos, with C = peak · V · F · n·l pulled out of the integral: V and
// n·l at `cosine`, F at ξ.
dvec3 shade_specular(const Surface& s, const Lobe& lobe, const dvec3& axis, double sharpness, double cosine) {
  const dvec3 local(glm::dot(axis, lobe.x), glm::dot(axis, lobe.y), glm::dot(axis, lobe.z));
  const double integral = asg_product(local, sharpness, lobe.eta_x, lobe.eta_y);
  const double half = 0.5 * glm::length(axis + s.view);  // cosine of the half angle
  const double factor = ndf_peak(s.ndf) * smith(cosine, lobe.nv, masking_alpha(s.ndf)) * cosine;
  return fresnel(s.f0, half) * (factor * integral);
}

// Reflected radiance per unit amplitude of incoming radiance G(ω;ξ,λ).
dvec3 shade_sg(const Surface& s, const Lobe& lobe, const dvec3& axis, double sharpness,
               const VsglShading& shading) {
  const double nl = std::clamp(glm::dot(axis, s.normal), -1.0, 1.0);
  const dvec3 diffuse = s.diffuse / pi * sg_integral(sharpness) * clamped_cosine_by(shading, nl, sharpness);
  return diffuse + shade_specular(s, lobe, axis, sharpness, std::max(nl, 0.0));
}

// A light from a surface, with the floors of distance and σ².
struct Sight {
  Sight(const Surface& s, const dvec3& mean, double given_variance) {
    const dvec3 to_mean = mean - s.position;
    distance2 = std::max(glm::dot(to_mean, to_mean), kLeastDistance2);
    direction = to_mean / std::sqrt(distance2);
    variance = std::max(given_variance, distance2 * kLeastVariance);
  }
  Sight(const Surface& s, const gpu::Vsgl& light, bool disk)
      : Sight(s, light.mean, (disk ? 0.5 : 1) * static_cast<double>(light.variance)) {}
  // The disk that the light is seen as has r² = 2σ² [VSGL14 §3.1]: 2π(1-cosθ) = 4π sin²(θ/2), tan θ = r/d.
  double radius2() const { return 2 * variance; }
  double solid_angle() const {
    return 4 * pi * square(std::sin(0.5 * std::atan2(std::sqrt(radius2()), std::sqrt(distance2))));
  }
  double distance2, variance;
  dvec3 direction;
};

dvec3 shade_vsgl16(const Surface& s, const gpu::Vsgl& light, const VsglShading& shading) {
  const Sight to(s, light, shading.disk);
  const double sharpness = to.distance2 / to.variance;  // λ_σ, Eq. (11)
  const Lobe receiver(s);
  dvec3 sum(0);
  const auto add = [&](const dvec3& intensity, const dvec3& axis, double lobe_sharpness) {
    const SgProduct p = sg_product(to.direction, sharpness, -axis, lobe_sharpness);
    const dvec3 amplitude = intensity / (2 * pi * to.variance) * std::exp(p.log_amplitude);  // Eq. (12)
    sum += amplitude * shade_sg(s, receiver, p.axis, p.sharpness, shading);
  };
  add(light.diffuse, light.diffuse_axis, light.diffuse_sharpness);
  add(light.specular, light.specular_axis, light.specular_sharpness);
  return sum;
}

// [VSGL14 Eq. 3] over πr²: Σ_j Σ_l 2 ĉ_j c_l <ω_i,n_s> <-ω_i,n_i> ∫ Ĝ_j G_l G_V.
dvec3 shade_vsgl14(const Surface& s, const gpu::Vsgl& light, const VsglShading& shading) {
  const Sight to(s, light, shading.disk);
  const Lobe receiver(s);
  const double cosine = std::max(glm::dot(to.direction, s.normal), 0.0);
  dvec3 sum(0);
  const auto add = [&](const dvec3& c, const dvec3& axis, double lobe_sharpness) {
    const SgProduct p = sg_product(to.direction, 4 * pi / to.solid_angle(), -axis, lobe_sharpness);
    const dvec3 diffuse = s.diffuse / pi * cosine * sg_integral(p.sharpness);
    const dvec3 specular = shade_specular(s, receiver, p.axis, p.sharpness, cosine);
    sum += 2.0 * c * std::exp(p.log_amplitude) * (diffuse + specular);
  };
  const dvec3 power = dvec3(light.diffuse) * sg_integral(light.diffuse_sharpness);
  add(power / pi * std::max(glm::dot(-to.direction, dvec3(light.diffuse_axis)), 0.0), light.diffuse_axis, 0);
  add(light.specular, light.specular_axis, light.specular_sharpness);
  return sum / (pi * to.radius2());
}

// ρ(ω) = Φ f(x2) f(x1) cos cos [VSGL14 §2].
dvec3 rho(const Surface& s, const gpu::Vpl& light, const dvec3& direction) {
  return dvec3(light.flux) * brdf_cosine(surface_of(light), -direction) * brdf_cosine(s, direction);
}

}  // namespace

double ndf_value(double ndf, const dvec3& n, const dvec3& h) {
  const dvec3 x = glm::cross(n, h);
  const double sine2 = std::min(glm::dot(x, x), 1.0);
  if (ndf > 0) return square(ndf) / (pi * square(sine2 + square(ndf) * (1 - sine2)));
  return ndf_peak(ndf) * std::exp(-0.5 * ndf * std::log1p(-sine2));
}

dvec3 brdf_cosine(const Surface& s, const dvec3& l) {
  const double nl = glm::dot(s.normal, l), nv = glm::dot(s.normal, s.view);
  if (nl <= 0 || nv <= 0 || glm::dot(s.geometric_normal, l) <= 0) return dvec3(0);
  const dvec3 h = unit_or(l + s.view, s.normal);
  const double specular = ndf_value(s.ndf, s.normal, h) * smith(nl, nv, masking_alpha(s.ndf));
  return (s.diffuse / pi + specular * fresnel(s.f0, glm::dot(l, h))) * nl;
}

Peak reflected_lobe(const Surface& s) {
  const double nv = std::max(glm::dot(s.normal, s.view), 0.05);
  return {reflect(s.view, s.normal), 2 * nv / std::sqrt(ndf_sharpness(s.ndf))};
}

Surface surface_of(const gpu::Vpl& light) {
  return {light.position, light.normal, light.geometric_normal, light.incident, light.diffuse,
          light.f0,       light.ndf};
}

dvec3 shade_vsgl(const Surface& s, const gpu::Vsgl& light, const VsglShading& shading) {
  if (light.power <= 0) return dvec3(0);
  return shading.model == VsglModel::vsgl14 ? shade_vsgl14(s, light, shading)
                                            : shade_vsgl16(s, light, shading);
}

double cancelling_alpha(const Surface& s, const gpu::Vsgl& light) {
  const Lobe lobe(s);
  const bool is_glossy = std::max({s.f0.x, s.f0.y, s.f0.z}) > 0;
  const auto sharpness = [](const glm::vec3& power, float value) {
    return power == glm::vec3(0) ? 0.0 : static_cast<double>(value);
  };
  const double receiver = is_glossy ? 2 * std::max(lobe.eta_x, lobe.eta_y) : 0;
  const double emitter = sharpness(light.specular, light.specular_sharpness);
  return (receiver + emitter) * Sight(s, light, false).solid_angle() / (4 * pi);
}

dvec3 shade_cancelled(const Surface& s, const gpu::Vsgl& light, const gpu::Vpl& texel) {
  const Sight to(s, light, false);
  return rho(s, texel, to.direction) * to.solid_angle() / (pi * to.radius2());
}

namespace {

Surface filtered(Surface s, const dvec3& l, double disk_sharpness) {
  const double half_angle_cosine =
      std::max(std::cos(0.5 * std::acos(std::clamp(glm::dot(l, s.view), -1.0, 1.0))), 1e-3);
  const double sharpness = 4 * half_angle_cosine * disk_sharpness;
  if (s.ndf > 0) {
    const double projected = square(s.ndf) / std::max(1 - square(s.ndf), 1e-6) + 2 / sharpness;
    s.ndf = std::sqrt(projected / (1 + projected));
  } else {
    s.ndf = -1 / (1 / -s.ndf + 1 / sharpness);
  }
  return s;
}

}  // namespace

dvec3 shade_filtered(const Surface& s, const gpu::FilteredLight& light) {
  const Sight to(s, light.mean, light.variance);
  const dvec3 normal(light.normal), to_mean = dvec3(light.mean) - s.position;
  const double height = -glm::dot(to_mean, normal), rise = glm::dot(to_mean, s.geometric_normal);
  if (height <= 0 || rise <= 0 || glm::dot(s.normal, s.view) <= 0) return dvec3(0);
  // Form factors of the disk from an element parallel to it and from an upright one that faces its axis;
  // S + |d²-r²| in place of the differences that cancel.
  const double r2 = to.radius2(), difference = to.distance2 - r2;
  const double root = std::sqrt(square(difference) + 4 * r2 * square(height));
  const double far = root + std::abs(difference);
  const double parallel = difference > 0 ? 2 * r2 * square(height) / (root * far) : far / (2 * root);
  const double upright_over_rho = 2 * r2 * height / (root * (root + to.distance2 + r2));
  const dvec3 flow = -parallel * normal + upright_over_rho * (to_mean + height * normal);
  const double size = std::min(glm::length(flow), 1.0), facing = glm::dot(flow, s.normal);
  const double reach = std::sqrt(r2 * std::max(1 - square(glm::dot(normal, s.geometric_normal)), 0.0));
  const double share = reach > 0 ? 0.625 * std::clamp(4 * std::min(reach - rise, rise) / reach, 0.0, 1.0) : 0;
  const double transfer =
      glm::mix(std::max(facing, 0.0), std::max(square(size) + facing, 0.0) / (size + 1), share) / r2;
  const double sharpness = 4 * pi / to.solid_angle();
  const auto over_cosine = [&](const Surface& material, const dvec3& l) {
    const double cosine = glm::dot(material.normal, l);
    return cosine > 0 ? brdf_cosine(filtered(material, l, sharpness), l) / cosine : material.diffuse / pi;
  };
  const Surface mirror{light.mean, normal, normal, light.incident, dvec3(0), light.f0, light.ndf};
  const dvec3 emitted = dvec3(light.diffuse) + dvec3(light.flux) * over_cosine(mirror, -to.direction);
  return emitted * over_cosine(s, to.direction) * transfer;
}

dvec3 shade_vpl(const Surface& s, const gpu::Vpl& light) {
  const dvec3 to_light = dvec3(light.position) - s.position;
  const double distance2 = glm::dot(to_light, to_light);
  if (light.power <= 0 || distance2 <= 0) return dvec3(0);
  return rho(s, light, to_light / std::sqrt(distance2)) / distance2;
}

Integral shade_vsl(const Surface& s, const gpu::Vpl& light, double relative_error) {
  const double radius = light.radius;
  if (light.power <= 0 || radius <= 0) return {};
  const dvec3 to_light = dvec3(light.position) - s.position;
  const double distance = glm::length(to_light);
  const Cone cone{unit_or(to_light, s.normal), distance > radius ? std::asin(radius / distance) : pi / 2};
  Peak emitter = reflected_lobe(surface_of(light));
  emitter.direction = -emitter.direction;
  const Peak peaks[] = {reflected_lobe(s), emitter};
  Integral integral =
      integrate(cone, peaks, relative_error, [&](const dvec3& l) { return rho(s, light, l); });
  integral.value /= pi * square(radius);
  integral.error /= pi * square(radius);
  return integral;
}

}  // namespace vsglbench::exact
