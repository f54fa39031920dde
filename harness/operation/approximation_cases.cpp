#include "operation/approximation_cases.h"

#include <cmath>
#include <numbers>

namespace vsglbench::approximation {

using glm::dvec3;

namespace {

dvec3 turned(const dvec3& v) {
  const dvec3 z = glm::normalize(dvec3(0.48, -0.6, 0.64)),
              x = glm::normalize(glm::cross(z, dvec3(0.2, 0.9, 0.3)));
  return v.x * x + v.y * glm::cross(z, x) + v.z * z;
}

}  // namespace

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

dvec3 normal() { return turned({0, 0, 1}); }
dvec3 view_at(double angle) { return turned({std::sin(angle), 0, std::cos(angle)}); }
dvec3 way_at(double angle) { return turned({-std::sin(angle), 0, std::cos(angle)}); }
dvec3 away_at(double angle) { return turned({-std::cos(angle), 0, -std::sin(angle)}); }
dvec3 across() { return turned({0, 1, 0}); }

gpu::Vpl record_of(const Material& material, const dvec3& normal, const dvec3& towards) {
  gpu::Vpl v{};
  v.normal = v.geometric_normal = normal;
  v.incident = towards;
  v.diffuse = glm::vec3(material.albedo);
  v.f0 = glm::vec3(material.f0);
  v.ndf = material.ndf;
  v.flux = glm::vec3(1);
  v.power = 1;
  return v;
}

ShadingPair mirror_pair(const Material& receiver, double angle, double sigma) {
  ShadingPair pair;
  pair.surface = record_of(receiver, normal(), view_at(angle));
  pair.light.mean = glm::vec3(way_at(angle));
  pair.light.variance = static_cast<float>(sigma * sigma);
  pair.light.diffuse_axis = pair.light.specular_axis = glm::vec3(-way_at(angle));
  pair.light.power = 1;
  return pair;
}

void set_texel(const Material& emitter, double angle, ShadingPair* pair) {
  const dvec3 back = -way_at(angle), incident = std::cos(0.7) * back + std::sin(0.7) * across();
  const dvec3 half = glm::normalize(back + incident);
  pair->texel =
      record_of(emitter, glm::normalize(half + 0.025 * away_at(angle) + 0.025 * across()), incident);
  pair->texel.position = pair->light.mean;
}

}  // namespace vsglbench::approximation
