// Both lights against sums over the texels in double.
#include <algorithm>

#include "method/test_field.h"

using namespace vsglbench;

namespace {

// The lights of the diffuse lobes alone and of the specular ones alone, by [MFIS16 App. B]'s own sums.
std::array<oracle::Vsgl, 2> in_double(const oracle::Half& half) {
  std::array<oracle::Sums, 2> sums;
  for (uint32_t y = 0; y < half.emitter.height; ++y) {
    for (uint32_t x = 0; x < half.emitter.width; ++x) {
      const oracle::Sums t = oracle::texel_sums(half, x, y);
      const double diffuse = oracle::luminance(t.diffuse), specular = oracle::luminance(t.specular);
      const double both = diffuse + specular;
      if (!(both > 0)) continue;
      sums[0].add({.diffuse = t.diffuse,
                   .diffuse_direction = t.diffuse_direction,
                   .position = diffuse / both * t.position,
                   .square = diffuse / both * t.square},
                  1);
      sums[1].add({.specular = t.specular,
                   .specular_direction = t.specular_direction,
                   .position = specular / both * t.position,
                   .square = specular / both * t.square},
                  1);
    }
  }
  return {oracle::make_vsgl(sums[0], 1), oracle::make_vsgl(sums[1], 1)};
}

void expect_near(const glm::vec3& a, const glm::dvec3& b, double scale, const char* what) {
  EXPECT_LT(glm::length(glm::dvec3(a) - b), 2e-5 * scale) << what;
}

void expect_same(const gpu::Vsgl& g, const oracle::Vsgl& c, bool is_diffuse) {
  EXPECT_NEAR(g.power / c.power, 1, 2e-5);
  EXPECT_NEAR(g.variance / c.variance, 1, 2e-5);
  expect_near(g.mean, c.mean, std::sqrt(c.variance), "mean");
  expect_near(is_diffuse ? g.diffuse : g.specular, is_diffuse ? c.diffuse : c.specular,
              glm::length(is_diffuse ? c.diffuse : c.specular), "intensity");
  expect_near(is_diffuse ? g.diffuse_axis : g.specular_axis, is_diffuse ? c.diffuse_axis : c.specular_axis, 1,
              "axis");
  EXPECT_NEAR((is_diffuse ? g.diffuse_sharpness : g.specular_sharpness) /
                  (is_diffuse ? c.diffuse_sharpness : c.specular_sharpness),
              1, 2e-5);
  EXPECT_EQ(is_diffuse ? g.specular : g.diffuse, glm::vec3(0));
}

class TwoVsgl : public ::testing::TestWithParam<glm::uvec2> {};

TEST_P(TwoVsgl, AreTheSumsOfAllTexels) {
  oracle::Half half = random_half(GetParam().x, GetParam().y, 8);
  half.texels[0].surface = true;
  // So that the two lobes do not lie alike: diffuse power to the left, specular to the right.
  for (size_t i = 0; i < half.texels.size(); ++i) {
    const float u = static_cast<float>(i % GetParam().x) / static_cast<float>(GetParam().x);
    half.texels[i].diffuse *= 1.1f - u;
    half.texels[i].f0 *= 0.1f + u;
  }
  const auto expected = in_double(half);
  const auto lights = MethodBench("two-vsgl").lights<gpu::Vsgl>(half, 2);
  expect_same(lights[0], expected[0], true);
  expect_same(lights[1], expected[1], false);
}

INSTANTIATE_TEST_SUITE_P(Sizes, TwoVsgl,
                         ::testing::Values(glm::uvec2(1, 1), glm::uvec2(64, 64), glm::uvec2(100, 37),
                                           glm::uvec2(512, 512)));

TEST(TwoVsgl, WithoutOneOfTheLobesItsLightIsNone) {
  oracle::Half half = random_half(40, 30, 9);
  for (auto& t : half.texels) t.f0 = glm::vec3(0);
  const auto lights = MethodBench("two-vsgl").lights<gpu::Vsgl>(half, 2);
  expect_same(lights[0], in_double(half)[0], true);
  EXPECT_EQ(lights[1].power, 0);
  for (auto& t : half.texels) t.surface = false;
  for (const auto& l : MethodBench("two-vsgl").lights<gpu::Vsgl>(half, 2)) EXPECT_EQ(l.power, 0);
}

}  // namespace
