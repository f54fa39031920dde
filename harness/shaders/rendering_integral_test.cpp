// The rendering integral against closed forms, and the reflected lobe's bandwidths by finite differences.
#include "shaders/rendering_integral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace vsglbench;
using namespace vsglbench::exact;
using glm::dvec3;

namespace {

constexpr double kPi = std::numbers::pi;

double radians(double degrees) { return degrees * kPi / 180; }

// Seen at this angle from the normal z.
exact::Surface surface(double degrees, double ndf) {
  const double a = radians(degrees);
  return {dvec3(0), {0, 0, 1}, {0, 0, 1}, {std::sin(a), 0, std::cos(a)}, dvec3(0), dvec3(1), ndf};
}

gpu::Vsgl light_at(const glm::vec3& mean, float variance) {
  gpu::Vsgl l{};
  l.mean = mean;
  l.variance = variance;
  l.diffuse_axis = l.specular_axis = -glm::normalize(mean);
  l.power = 1;
  return l;
}

}  // namespace

// Derived from the half vector in rendering_integral.h: λh/8 in the plane of incidence, λh/(8 (n·v)²) across
// it. GGX falls from its peak as an SG of 4(1-α²)/α²; the papers' 2/α² [VSGL15s App. A] is that of the SG
// with its peak and integral.
TEST(ReflectedLobe, IsNarrowerAcrossThePlaneOfIncidence) {
  for (const double ndf : {-1000.0, std::sqrt(4 / 1004.0)}) {
    for (const auto& [degrees, across] : {std::pair(0.0, 125.0), {60.0, 500.0}, {75.0, 1866.0}}) {
      const auto [in_plane, other] = reflected_bandwidths(surface(degrees, ndf));
      EXPECT_NEAR(in_plane, 125, 0.5) << degrees << " " << ndf;
      EXPECT_NEAR(other / across, 1, 5e-3) << degrees << " " << ndf;
    }
  }
}

// A Lambert surface under an SG: Rd/π A(λ) L(v,κ), L by another quadrature.
TEST(RenderingIntegral, OfLambertIsTheClampedCosine) {
  for (const double sharpness : {0.0, 0.5, 8.0, 300.0}) {
    for (const double degrees : {0.0, 60.0, 89.0, 120.0}) {
      exact::Surface s = surface(30, 1);
      s.diffuse = dvec3(0.7);
      s.f0 = dvec3(0);
      const double a = radians(degrees);
      const dvec3 axis(std::sin(a), 0, std::cos(a));
      const double expected = 0.7 / kPi * sg_integral(sharpness) * clamped_cosine(std::cos(a), sharpness);
      const double value = reflected_radiance(s, incoming_sg(axis, sharpness), 1e-6).value.x;
      EXPECT_NEAR(value / expected, 1, 1e-5) << sharpness << " " << degrees;
    }
  }
}

// Under radiance 1 from everywhere a microfacet surface of F0 = 1 reflects no more than that; a sharp one
// seen from above all but all of it.
TEST(RenderingIntegral, KeepsEnergy) {
  for (const double ndf : {0.05, 0.1, 0.3, 1.0, -30.0, -300.0, -1023.0, -65535.0}) {
    for (const double degrees : {0.0, 45.0, 75.0, 85.0}) {
      const double albedo =
          reflected_radiance(surface(degrees, ndf), incoming_sg({0, 0, 1}, 0), 1e-4).value.x;
      EXPECT_LT(albedo, ndf < 0 ? 1.07 : 1.001) << ndf << " " << degrees;  // Phong: (n+2)/n F G
      EXPECT_GT(albedo, ndf == 1 ? 0.3 : 0.4) << ndf << " " << degrees;    // 1-ln 2 at 0°
      if (ndf < -1000 && degrees < 50) {
        EXPECT_GT(albedo, 0.99) << ndf << " " << degrees;
      }
    }
  }
}

// A Gaussian's lights far away, and a disk's, are points: I cos/d²; near, the first is its definition: a sum
// of lights.
TEST(RenderingIntegral, OfFarLightsIsThatOfPoints) {
  exact::Surface s = surface(20, 0.5);
  s.diffuse = dvec3(0.5);
  gpu::Vsgl l = light_at({0.5f, 0, 2}, 1e-6f);
  l.specular = glm::vec3(3);
  l.specular_sharpness = 5;
  const dvec3 mean(l.mean);
  const double expected = 3 * brdf_cosine(s, glm::normalize(mean)).x / glm::dot(mean, mean);
  EXPECT_NEAR(reflected_radiance(s, incoming_gaussian(l, s.position), 1e-6).value.x / expected, 1, 1e-4);
  EXPECT_NEAR(reflected_radiance(s, incoming_disk(l, s.position), 1e-6).value.x / expected, 1, 1e-4);
}

TEST(RenderingIntegral, OfAGaussianIsTheSumOfItsLights) {
  exact::Surface s = surface(20, 0.5);
  s.diffuse = dvec3(0.5);
  gpu::Vsgl l = light_at({0.5f, 0, 2}, 0.3f);
  l.specular = glm::vec3(3);
  l.specular_sharpness = 5;
  // Midpoints over ±5σ in space: those below the horizon give nothing.
  constexpr int kSteps = 60;
  const double sigma = std::sqrt(double{l.variance}), step = 10 * sigma / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const dvec3 index(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps);
    const dvec3 offset = (index + 0.5) * step - 5 * sigma, y = dvec3(l.mean) + offset;
    const double density =
        std::exp(-glm::dot(offset, offset) / (2 * l.variance)) / std::pow(2 * kPi * l.variance, 1.5);
    const dvec3 to = glm::normalize(y);
    const double intensity = 3 * sg_value(-to, l.specular_axis, 5);
    sum += density * step * step * step * intensity * brdf_cosine(s, to).x / glm::dot(y, y);
  }
  const double value = reflected_radiance(s, incoming_gaussian(l, s.position), 1e-5).value.x;
  EXPECT_NEAR(value / sum, 1, 2e-3);
}
