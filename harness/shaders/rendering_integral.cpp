#include "shaders/rendering_integral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench::exact {
namespace {

using glm::dvec3;
using std::numbers::pi;

double square(double x) { return x * x; }

// Past e^{-60} of an SG nothing is left.
Cone cone_of(const dvec3& axis, double sharpness) {
  return {axis, sharpness > 30 ? std::acos(1 - 60 / sharpness) : pi};
}

double width_of(double sharpness) { return 1 / std::sqrt(std::max(sharpness, 0.1)); }

dvec3 specular_intensity(const gpu::Vsgl& light, const dvec3& direction) {
  return dvec3(light.specular) * sg_value(direction, light.specular_axis, light.specular_sharpness);
}

// Way to a light's mean.
struct Way {
  Way(const dvec3& to, const dvec3& position) {
    const dvec3 difference = to - position;
    distance = glm::length(difference);
    direction = difference / distance;
  }
  double distance;
  dvec3 direction;
};

Incoming disk(const gpu::Vsgl& light, const dvec3& position,
              const std::function<dvec3(const dvec3&)>& intensity, const Peak& peak) {
  const Way way(light.mean, position);
  const double radius = std::sqrt(2.0 * light.variance), area = pi * square(radius);
  return {[=](const dvec3& l) { return intensity(-l) / area; },
          {{-peak.direction, peak.width}},
          {way.direction, std::atan2(radius, way.distance)}};
}

}  // namespace

Incoming incoming_sg(const dvec3& axis, double sharpness) {
  return {[=](const dvec3& l) { return dvec3(sg_value(l, axis, sharpness)); },
          {{axis, width_of(sharpness)}},
          cone_of(axis, sharpness)};
}

Incoming incoming_gaussian(const gpu::Vsgl& light, const dvec3& position) {
  const Way way(light.mean, position);
  const double variance = light.variance, spread = square(way.distance) / variance;  // (d/σ)²
  const auto radiance = [=](const dvec3& l) {
    const dvec3 across = glm::cross(way.direction, l);
    const double along = std::sqrt(spread / 2) * glm::dot(way.direction, l);
    const double density = std::exp(-0.5 * spread * glm::dot(across, across)) * 0.5 * std::erfc(-along);
    const dvec3 diffuse = dvec3(light.diffuse) * sg_value(-l, light.diffuse_axis, light.diffuse_sharpness);
    return (diffuse + specular_intensity(light, -l)) * (density / (2 * pi * variance));
  };
  return {radiance,
          {{way.direction, width_of(spread)},
           {-dvec3(light.specular_axis), width_of(light.specular_sharpness)},
           {-dvec3(light.diffuse_axis), width_of(light.diffuse_sharpness)}},
          {way.direction, spread > 240 ? std::asin(std::sqrt(120 / spread)) : pi}};
}

Incoming incoming_disk(const gpu::Vsgl& light, const dvec3& position) {
  const double power = sg_integral(light.diffuse_sharpness) / pi;
  const auto intensity = [=](const dvec3& l) {
    const double cosine = std::max(glm::dot(l, dvec3(light.diffuse_axis)), 0.0);
    return dvec3(light.diffuse) * (power * cosine) + specular_intensity(light, l);
  };
  return disk(light, position, intensity, {light.specular_axis, width_of(light.specular_sharpness)});
}

Incoming incoming_disk(const gpu::Vsgl& light, const gpu::Vpl& texel, const dvec3& position) {
  const Surface emitter = surface_of(texel);
  const auto intensity = [=](const dvec3& l) { return dvec3(texel.flux) * brdf_cosine(emitter, l); };
  return disk(light, position, intensity, reflected_lobe(emitter));
}

Integral reflected_radiance(const Surface& surface, const Incoming& incoming, double relative_error) {
  std::vector<Peak> peaks = incoming.peaks;
  if (surface.f0 != dvec3(0)) peaks.push_back(reflected_lobe(surface));
  return integrate(incoming.cone, peaks, relative_error,
                   [&](const dvec3& l) { return brdf_cosine(surface, l) * incoming.radiance(l); });
}

// A point of the disk is the foot of one of the hemisphere: dA = r² cosθ dω.
Integral radiance_of_disk(const Surface& surface, const gpu::Vpl& texel, double variance,
                          double relative_error) {
  const Surface emitter = surface_of(texel);
  const double radius = std::sqrt(2 * variance);
  return integrate({emitter.normal, pi / 2}, {}, relative_error, [&](const dvec3& w) {
    const double cosine = glm::dot(w, emitter.normal);
    const dvec3 to_point = emitter.position + radius * (w - cosine * emitter.normal) - surface.position;
    const double distance2 = glm::dot(to_point, to_point);
    const dvec3 l = to_point / std::sqrt(distance2);
    return dvec3(texel.flux) * brdf_cosine(emitter, -l) * brdf_cosine(surface, l) *
           (cosine / (pi * distance2));
  });
}

std::pair<double, double> reflected_bandwidths(const Surface& surface) {
  const dvec3 n = surface.normal, v = surface.view, mirror = 2 * glm::dot(n, v) * n - v;
  const dvec3 any = std::abs(n.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 across = unit_or(glm::cross(n, v), glm::normalize(glm::cross(n, any)));
  // -ln of D(h)/D(n) over δ², ω at an angle δ on either side, by Richardson's extrapolation.
  const auto bandwidth = [&](const dvec3& tangent) {
    const auto at = [&](double delta) {
      double sum = 0;
      for (const double side : {-delta, delta}) {
        const dvec3 l = std::cos(side) * mirror + std::sin(side) * tangent;
        sum -= std::log(ndf_value(surface.ndf, n, glm::normalize(l + v)) / ndf_value(surface.ndf, n, n)) / 2;
      }
      return sum / square(delta);
    };
    const double step = 0.02 * reflected_lobe(surface).width;
    return (4 * at(step) - at(2 * step)) / 3;
  };
  return {bandwidth(glm::cross(across, mirror)), bandwidth(across)};
}

}  // namespace vsglbench::exact
