// filtered_lights.comp against what a VSGL of one texel is: that texel's VPL.
#include "frame/filtered_lights.h"

#include <gtest/gtest.h>

#include <numbers>

#include "frame/stage.h"
#include "method/made_half.h"

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr uint32_t kWidth = 24, kHeight = 17;

struct TexelLight {
  const oracle::Texel* texel;
  dvec3 flux;
  gpu::Vsgl light;
};

// A light of every texel that has a surface which is lit at no grazing angle.
std::vector<TexelLight> lights_of(const oracle::Half& half) {
  std::vector<TexelLight> out;
  for (uint32_t i = 0; i < half.texels.size(); ++i) {
    const oracle::Texel& t = half.texels[i];
    const dvec3 incident = glm::normalize(dvec3(half.emitter.position) - dvec3(t.position));
    if (!t.surface || glm::dot(incident, dvec3(t.normal)) < 0.1) continue;
    const oracle::Vsgl v = oracle::make_vsgl(oracle::texel_sums(half, i % kWidth, i / kWidth), 1);
    gpu::Vsgl light{};
    light.mean = v.mean;
    light.variance = static_cast<float>(v.variance);
    light.diffuse = v.diffuse;
    light.diffuse_sharpness = static_cast<float>(v.diffuse_sharpness);
    light.diffuse_axis = v.diffuse_axis;
    light.specular = v.specular;
    light.specular_sharpness = static_cast<float>(v.specular_sharpness);
    light.specular_axis = v.specular_axis;
    light.power = static_cast<float>(v.power);
    out.push_back({&t, oracle::texel_flux(half.emitter, i % kWidth, i / kWidth), light});
  }
  return out;
}

std::vector<gpu::FilteredLight> filtered(const oracle::Half& half, const std::vector<TexelLight>& lights) {
  static Device device;
  static KernelLibrary kernels(device);
  constexpr unsigned kBoth = DIFFUSE_LOBE | SPECULAR_LOBE;
  const DeviceHalf rsm(device, half);
  std::vector<gpu::Vsgl> given;
  for (const TexelLight& l : lights) given.push_back(l.light);
  const auto count = static_cast<uint32_t>(given.size());
  Buffer from(device, "lights", given.size() * sizeof(gpu::Vsgl));
  from.upload(given.data(), given.size() * sizeof(gpu::Vsgl));
  const Buffer to(device, "filtered lights", count * filtered_light_stride(kBoth));
  Recorder recorder(device);
  recorder.begin();
  recorder.pass({.stage = PassStage::shade}, [&] {
    record_filtered_lights(recorder, kernels, rsm.field(Half::rsm, false), {{"shading", "filtered"}}, {},
                           from, count, to);
  });
  recorder.submit_and_wait();
  return read_filtered_lights(to, count, kBoth);
}

void expect_near(const glm::vec3& a, const dvec3& b, double relative) {
  EXPECT_LT(glm::length(dvec3(a) - b), relative * std::max(glm::length(b), 1e-30));
}

TEST(FilteredLights, OfOneTexelAreItsVpl) {
  for (const uint32_t seed : {1u, 2u}) {
    const oracle::Half half = random_half(kWidth, kHeight, seed);
    const auto lights = lights_of(half);
    ASSERT_GT(lights.size(), 100u);
    const auto made = filtered(half, lights);
    for (size_t i = 0; i < lights.size(); ++i) {
      SCOPED_TRACE(i);
      const auto& [t, flux, given] = lights[i];
      const gpu::FilteredLight& f = made[i];
      const bool reflects[3] = {t->diffuse.x + t->f0.x > 0, t->diffuse.y + t->f0.y > 0,
                                t->diffuse.z + t->f0.z > 0};
      dvec3 expected = flux;
      for (int k = 0; k < 3; ++k) expected[k] *= reflects[k] ? 1 : 0;
      expect_near(f.mean, t->position, 1e-5);
      expect_near(f.normal, t->normal, 1e-4);
      expect_near(f.incident, glm::normalize(dvec3(half.emitter.position) - dvec3(t->position)), 1e-4);
      expect_near(f.flux, expected, 1e-3);
      expect_near(f.diffuse, expected * dvec3(t->diffuse) / std::numbers::pi, 1e-3);
      expect_near(f.f0, t->f0, 1e-6);
      EXPECT_NEAR(f.ndf / t->ndf, 1, 5e-3);
    }
  }
}

// Half vectors of a lobe of sharpness λ about a mirror direction have the sharpness 4 cosθ λ [VSGL15s App.
// A]. What a light's lobe is wider by than its texel's, 1/λ, adds to the texel's distribution: 2/λ to GGX's
// α²/(1-α²), 1/λ to the inverse of Phong's exponent.
TEST(FilteredLights, AreAsWideAsTheirLobes) {
  const oracle::Half half = random_half(kWidth, kHeight, 3);
  auto lights = lights_of(half);
  std::erase_if(lights, [](const TexelLight& l) { return l.light.specular_sharpness <= 0; });
  for (TexelLight& l : lights) l.light.specular_sharpness *= 0.25f;
  const auto made = filtered(half, lights);
  size_t checked = 0;
  for (size_t i = 0; i < lights.size(); ++i) {
    SCOPED_TRACE(i);
    const auto& [t, flux, given] = lights[i];
    const double cosine =
        glm::dot(glm::normalize(dvec3(half.emitter.position) - dvec3(t->position)), dvec3(t->normal));
    const double own = t->ndf > 0 ? t->ndf * t->ndf / 2 : -1 / t->ndf;  // 1/λ of half vectors
    const double wider = 1 / (4 * cosine * given.specular_sharpness) - own;
    if (wider < 0.01 * own || t->ndf > 0.95f) continue;
    ++checked;
    if (t->ndf > 0) {
      const double slope2 = t->ndf * t->ndf / (1.0 - t->ndf * t->ndf) + 2 * wider;
      EXPECT_NEAR(made[i].ndf / std::sqrt(slope2 / (1 + slope2)), 1, 0.01);
    } else {
      EXPECT_NEAR(-made[i].ndf * (own + wider), 1, 0.01);
    }
  }
  EXPECT_GT(checked, 50u);
}

// Of surfaces that turn, the mirror directions are what is averaged: the light has to send its lobe there,
// however the one texel at its mean is turned.
TEST(FilteredLights, OfMetalSendTheirLobeWhereItsAxisIs) {
  oracle::Half half = random_half(kWidth, kHeight, 5);
  for (oracle::Texel& t : half.texels) {
    t.diffuse = glm::vec3(0);
    t.f0 = glm::vec3(0.9f, 0.7f, 0.5f);
  }
  auto lights = lights_of(half);
  ASSERT_GT(lights.size(), 100u);
  for (size_t i = 0; i < lights.size(); ++i) {
    glm::vec3& axis = lights[i].light.specular_axis;
    axis = glm::normalize(axis + 0.2f * lights[(i + 1) % lights.size()].light.specular_axis);
  }
  const auto made = filtered(half, lights);
  size_t turned = 0;
  for (size_t i = 0; i < lights.size(); ++i) {
    SCOPED_TRACE(i);
    const dvec3 normal(made[i].normal), incident(made[i].incident), axis(lights[i].light.specular_axis);
    expect_near(made[i].normal, glm::normalize(normal), 1e-4);
    expect_near(glm::vec3(2 * glm::dot(normal, incident) * normal - incident), axis, 1e-3);
    turned += glm::distance(normal, dvec3(lights[i].texel->normal)) > 0.02 ? 1 : 0;
  }
  EXPECT_GT(turned, lights.size() / 2);
  // Where the texel at the mean has no lobe: a Lambert surface that faces where the lobe went.
  for (oracle::Texel& t : half.texels) {
    t.diffuse = glm::vec3(0.5f);
    t.f0 = glm::vec3(0);
  }
  const auto lambert = filtered(half, lights);
  for (size_t i = 0; i < lights.size(); ++i) {
    SCOPED_TRACE(i);
    expect_near(lambert[i].normal, lights[i].light.specular_axis, 1e-6);
    EXPECT_EQ(lambert[i].f0, glm::vec3(0));
    EXPECT_GT(lambert[i].diffuse.x, 0);
  }
}

TEST(FilteredLights, WithoutPowerOrSurfaceAreBlackOrLambert) {
  oracle::Half half = random_half(kWidth, kHeight, 4);
  auto lights = lights_of(half);
  for (oracle::Texel& t : half.texels) t.surface = false;
  lights.resize(2);
  lights[0].light.power = 0;
  lights[1].light.diffuse = {1, 2, 3};
  lights[1].light.diffuse_sharpness = 2;
  const auto made = filtered(half, lights);
  EXPECT_EQ(made[0].flux, glm::vec3(0));
  EXPECT_EQ(made[0].diffuse, glm::vec3(0));
  EXPECT_EQ(made[1].flux, glm::vec3(0));
  EXPECT_GT(made[1].diffuse.x, 0);
  expect_near(made[1].normal, lights[1].light.diffuse_axis, 1e-6);
}

}  // namespace
}  // namespace vsglbench
