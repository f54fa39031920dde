#include "frame/light_flux.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench {
namespace {

using glm::dvec3;

double luminance(const dvec3& c) { return glm::dot(c, dvec3(0.2126, 0.7152, 0.0722)); }

// ∫G over the sphere.
double sg_integral(double sharpness) {
  return sharpness > 1e-6 ? 2 * std::numbers::pi * -std::expm1(-2 * sharpness) / sharpness
                          : 4 * std::numbers::pi;
}

// Flux that arrives through texel (x, y), per unit of the emitter's power [light-transport §1].
double texel_share(const gpu::Emitter& e, uint32_t x, uint32_t y) {
  const double area = 4.0 * e.extent.x * e.extent.y / (double(e.width) * e.height);
  if (!e.perspective) return area;
  const double right = (2 * (x + 0.5) / e.width - 1) * e.extent.x;
  const double up = (1 - 2 * (y + 0.5) / e.height) * e.extent.y;
  return area * std::pow(1 + right * right + up * up, -1.5);
}

}  // namespace

dvec3 lobe_reflectance(const glm::vec3& diffuse, const glm::vec3& f0, double ndf, double cosine) {
  const double c = std::clamp(cosine, 1e-3, 1.0);
  const double alpha = ndf > 0 ? ndf : std::sqrt(2 / (2 - ndf));           // of a Phong exponent -ndf
  const double g2 = 1 / std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1));  // Heitz 2014, both ways alike
  const double peak = ndf > 0 ? 1 : (2 - ndf) / -ndf;
  const double f90 = std::min(1.0, 50.0 * std::max({f0.x, f0.y, f0.z}));
  const dvec3 fresnel = dvec3(f0) + (dvec3(f90) - dvec3(f0)) * std::pow(1 - c, 5);
  return dvec3(diffuse) + glm::min(fresnel * (g2 * peak), dvec3(1));
}

dvec3 lobe_power(const gpu::Vsgl& v) {
  return dvec3(v.diffuse) * sg_integral(v.diffuse_sharpness) +
         dvec3(v.specular) * sg_integral(v.specular_sharpness);
}

double reflected_power(const gpu::Vsgl& v) { return luminance(lobe_power(v)); }

double incident_power(const gpu::Vpl& v) { return luminance(dvec3(v.flux)); }

double reflected_power(const gpu::Vpl& v) {
  if (!(v.power > 0)) return 0;
  const double cosine = glm::dot(dvec3(v.normal), dvec3(v.incident));
  return luminance(dvec3(v.flux) * lobe_reflectance(v.diffuse, v.f0, v.ndf, cosine));
}

double reflected_power(const gpu::Emitter& e, const std::array<std::vector<glm::vec4>, 5>& maps) {
  double sum = 0;
  for (size_t i = 0; i < maps[0].size(); ++i) {
    if (!(maps[0][i].w > 0)) continue;
    const dvec3 to = dvec3(e.position) - dvec3(maps[0][i]);
    const dvec3 view = e.perspective ? glm::normalize(to) : -dvec3(e.forward);
    const dvec3 normal(maps[1][i]);
    const dvec3 reflected =
        lobe_reflectance(maps[3][i], maps[4][i], maps[1][i].w, glm::dot(normal, view)) * dvec3(e.power);
    sum += luminance(reflected) *
           texel_share(e, static_cast<uint32_t>(i % e.width), static_cast<uint32_t>(i / e.width));
  }
  return sum;
}

}  // namespace vsglbench
