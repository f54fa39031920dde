#include "frame/light_flux.h"

#include <gtest/gtest.h>

#include "method/made_half.h"

namespace vsglbench {
namespace {

std::array<std::vector<glm::vec4>, 5> maps_of(const oracle::Half& half) {
  std::array<std::vector<glm::vec4>, 5> maps;
  for (const oracle::Texel& t : half.texels) {
    const std::array<glm::vec4, 5> texel = {glm::vec4(t.position, 1), glm::vec4(t.normal, t.ndf),
                                            glm::vec4(t.geometric_normal, 0), glm::vec4(t.diffuse, 0),
                                            glm::vec4(t.f0, 0)};
    for (size_t k = 0; k < 5; ++k) maps[k].push_back(t.surface ? texel[k] : glm::vec4(0));
  }
  return maps;
}

// By hand: a surface lit along its normal reflects Rd + F0; a Phong lobe (n+2)/n of it.
TEST(LightFlux, ReflectanceOfSurfacesLitHeadOn) {
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-6); };
  near(lobe_reflectance({0.5f, 0.25f, 0}, {0.1f, 0.2f, 0.3f}, 0.5, 1), {0.6, 0.45, 0.3});
  near(lobe_reflectance({0, 0, 0}, {0.1f, 0.2f, 0.3f}, -4, 1), {0.15, 0.3, 0.45});
  near(lobe_reflectance({0, 0, 0}, {0.9f, 0.9f, 0.9f}, -1, 1), {1, 1, 1});  // never more than arrives
  near(lobe_reflectance({0.5f, 0.5f, 0.5f}, {0, 0, 0}, 0.5, 0.3), {0.5, 0.5, 0.5});
  // α = 1 at 60°: G2 = 1/√(1+3) and Schlick's (1-cos)^5 = 1/32.
  near(lobe_reflectance({0, 0, 0}, glm::vec3(0.5f), 1, 0.5), glm::dvec3((0.5 + 0.5 / 32) / 2));
}

TEST(LightFlux, TexelsReflectWhatTheOracleSumsOverThem) {
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    const oracle::Half half = random_half(37, 23, seed);
    const double expected = texel_power(half, LightKind::vsgl);
    EXPECT_NEAR(reflected_power(half.emitter, maps_of(half)) / expected, 1, 1e-6);
  }
}

// A VPL of a texel and its VSGL reflect the same.
TEST(LightFlux, AVplCarriesWhatItsTexelReflects) {
  const oracle::Half half = random_half(5, 4, 9);
  double vpls = 0;
  for (uint32_t i = 0; i < half.texels.size(); ++i) {
    const oracle::Texel& t = half.texels[i];
    if (!t.surface) continue;
    gpu::Vpl light{};
    light.normal = t.normal;
    light.incident = glm::normalize(half.emitter.position - t.position);
    light.diffuse = t.diffuse;
    light.f0 = t.f0;
    light.ndf = t.ndf;
    light.flux = glm::vec3(oracle::texel_flux(half.emitter, i % 5, i / 5));
    light.power = static_cast<float>(oracle::luminance(light.flux));
    vpls += reflected_power(light);
  }
  EXPECT_NEAR(vpls / texel_power(half, LightKind::vsgl), 1, 1e-5);
}

}  // namespace
}  // namespace vsglbench
