#include "lights/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vsglbench {
namespace {

constexpr double kTight = 1e-12;

TEST(Coverage, NoLightIsAllGap) {
  for (const auto& footprints : {std::vector<glm::vec4>{}, std::vector<glm::vec4>{{2, 2, 0, 0}}}) {
    const Coverage c = cover_footprints(footprints, 4, 4, {});
    EXPECT_EQ(c.overlap, 0);
    EXPECT_EQ(c.gap, 1);
    EXPECT_FALSE(c.pdf_overlap || c.pdf_gap);
  }
}

// At the centre of a texel of its level a footprint holds just that texel.
TEST(Coverage, TilesLeaveNothingAndShareNothing) {
  std::vector<glm::vec4> tiles;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) tiles.push_back({2 + 4 * x, 2 + 4 * y, 4, 0});
  }
  const Coverage c = cover_footprints(tiles, 12, 12, std::vector<float>(144, 0.25f));
  EXPECT_NEAR(c.overlap, 0, kTight);
  EXPECT_NEAR(c.gap, 0, kTight);
  EXPECT_NEAR(*c.pdf_overlap, 0, kTight);
  EXPECT_NEAR(*c.pdf_gap, 0, kTight);
}

// A footprint of side 2 on the corner of four blocks of 2 × 2 holds a quarter of each of their 16 texels.
TEST(Coverage, ATextureTapReachesFartherThanTheSide) {
  const Coverage one = cover_footprints({{4, 4, 2, 0}}, 8, 8, {});
  EXPECT_NEAR(one.overlap, 0, kTight);
  EXPECT_NEAR(one.gap, (48 + 16 * 0.75) / 64, kTight);
  const Coverage six = cover_footprints(std::vector<glm::vec4>(6, {4, 4, 2, 0}), 8, 8, {});
  EXPECT_NEAR(six.overlap, 16 * 0.5 / 64, kTight);
  EXPECT_NEAR(six.gap, 48.0 / 64, kTight);
}

// Between two levels: half of area 2^3 in the block of 4 × 4 that it is in, half in that of 2 × 2.
TEST(Coverage, BetweenLevelsBothCount) {
  const Coverage c = cover_footprints({{2, 2, std::exp2(1.5f), 0}}, 4, 4, {});
  // Level 1 at its texels' common corner: 4 in all over 16 texels; level 2: 4 in all over the same 16.
  EXPECT_NEAR(c.gap, 0.5, 1e-6);
}

// Rows and columns that differ: a mistake of axis shows.
TEST(Coverage, WeighsTexelsByThePdf) {
  const std::vector<float> pdf = {1, 2, 0, 4, 8, 0};  // 3 × 2 texels
  const Coverage c =
      cover_footprints({{0.5, 0.5, 1, 0}, {0.5, 1.5, 1, 0}, {0.5, 1.5, 1, 0}, {1.5, 0.5, 1, 0}}, 3, 2, pdf);
  EXPECT_NEAR(*c.pdf_overlap, 4.0 / 15, kTight);
  EXPECT_NEAR(*c.pdf_gap, 8.0 / 15, kTight);
  EXPECT_NEAR(c.gap, 3.0 / 6, kTight);
  EXPECT_FALSE(cover_footprints({}, 3, 2, std::vector<float>(6, 0)).pdf_gap);
}

// A footprint at every texel of an odd image counts all texels alike, on every level: 4^l times.
TEST(Coverage, FootprintsAtEveryTexelHoldAllOfThemAlike) {
  constexpr uint32_t kWidth = 61, kHeight = 35;
  for (const float side : {1.0f, 2.0f, 8.0f, 32.0f}) {
    std::vector<glm::vec4> footprints;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i)
      footprints.push_back({i % kWidth + 0.5f, static_cast<float>(i / kWidth) + 0.5f, side, 0});
    const Coverage c = cover_footprints(footprints, kWidth, kHeight, {});
    EXPECT_NEAR(c.overlap, side * side - 1, 1e-9 * side * side);
    EXPECT_NEAR(c.gap, 0, kTight);
  }
}

TEST(Coverage, APartitionHasGapsOnly) {
  const std::vector<uint32_t> clusters = {0, 1, 2, 2, 3, 4, 1, 0};  // of 3 lights: texels 4 and 5 are in none
  const Coverage c = cover_clusters(clusters, 3, {1, 1, 1, 1, 3, 1, 0, 0});
  EXPECT_EQ(c.overlap, 0);
  EXPECT_EQ(*c.pdf_overlap, 0);
  EXPECT_DOUBLE_EQ(c.gap, 0.25);
  EXPECT_DOUBLE_EQ(*c.pdf_gap, 0.5);
}

// --- kernel masses ---

// What trilinear filtering says, by the pyramid's definition (shaders/pyramid.glsl), texel by texel: how much
// of the block that texel `t` is in, on one axis of a level, a position takes, over the block's base texels.
double weight_on_axis(uint32_t base, uint32_t level, double position, uint32_t t) {
  const double block = std::exp2(level);
  const int last = static_cast<int>(std::ceil(base / block)) - 1, own = static_cast<int>(t / block);
  const auto part = [&](int b) { return std::min(block, base - b * block); };  // base texels of a block
  const double centre = std::min(std::max(position / block - 0.5, 0.0), double(last));
  double weight = std::max(0.0, 1 - std::abs(centre - own));
  // The last block, where less than half of one, weighs as much as it covers in the mean over positions.
  const double c = part(last) / block;
  if (c < 0.5 && last > 0 && centre > last - 1) {
    const double of_last = (centre - (last - 1)) * c / (0.5 * (0.5 + c) * (0.5 + c));
    weight = own == last ? of_last : own == last - 1 ? 1 - of_last : 0;
  }
  return weight / part(own);
}

double mass_by_count(const glm::vec4& footprint, size_t lights, uint32_t width, uint32_t height,
                     const std::vector<float>& pdf) {
  if (footprint.z == 0) return 0;
  const double top = std::ceil(std::log2(double(std::max(width, height))));
  const double level = std::min(std::max(0.0, std::log2(double(footprint.z))), top);
  const auto lower = static_cast<uint32_t>(std::floor(level));
  double held = 0, all = 0;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      double filtered = 0;
      for (uint32_t l = lower; l <= lower + 1 && l <= top; ++l) {
        filtered += (1 - std::abs(level - l)) * weight_on_axis(width, l, footprint.x, x) *
                    weight_on_axis(height, l, footprint.y, y);
      }
      held += std::pow(4.0, level) * filtered * pdf[y * width + x];
      all += pdf[y * width + x];
    }
  }
  return double(lights) * held / all;
}

TEST(KernelMasses, AreSumsOverAllTexels) {
  std::mt19937 random(7);
  const auto uniform = [&](double from, double to) {
    return static_cast<float>(std::uniform_real_distribution<>(from, to)(random));
  };
  for (const auto& [width, height] :
       {std::pair{1u, 1u}, {16u, 16u}, {61u, 35u}, {9u, 1u}, {33u, 64u}, {5u, 65u}}) {
    std::vector<float> pdf(width * height);
    for (float& p : pdf) p = uniform(0, 1) < 0.3f ? 0 : std::exp(uniform(-12, 6));
    pdf[0] = 1;
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    std::vector<glm::vec4> footprints = {
        {0, 0, 3, 0}, {w, h, 5, 0}, {0, h, 1, 0}, {w, 0, 300, 0}, {1, 1, 0, 0}};
    for (int i = 0; i < 60; ++i)
      footprints.push_back({uniform(0, w), uniform(0, h), std::exp2(uniform(-1, std::log2(2 * w * h))), 0});
    const auto masses = kernel_masses(footprints, width, height, pdf);
    ASSERT_EQ(masses.size(), footprints.size());
    for (size_t i = 0; i < masses.size(); ++i) {
      const double counted = mass_by_count(footprints[i], footprints.size(), width, height, pdf);
      EXPECT_NEAR(masses[i], counted, 1e-10 * (counted + 1e-3))
          << width << "×" << height << " centre " << footprints[i].x << " " << footprints[i].y << " side "
          << footprints[i].z;
    }
  }
}

TEST(KernelMasses, OneTexelHoldsNTimesItsShare) {
  const auto masses =
      kernel_masses({{0.5, 1.5, 1, 0}, {1.5, 0.5, 1, 0}, {0, 0, 0, 0}}, 3, 2, {1, 2, 0, 4, 8, 1});
  EXPECT_NEAR(masses.at(0), 3 * 4.0 / 16, kTight);
  EXPECT_NEAR(masses.at(1), 3 * 2.0 / 16, kTight);
  EXPECT_EQ(masses.at(2), 0);
}

// Tiles of an even PDF each hold what [MFIS16 Eq. 2] asks for; of twice the side, four times as much.
TEST(KernelMasses, TilesOfAnEvenPdfAreAsIntended) {
  for (const float side : {4.0f, 8.0f}) {
    std::vector<glm::vec4> tiles;
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) tiles.push_back({2 + 4 * x, 2 + 4 * y, side, 0});
    }
    for (const double mass : kernel_masses(tiles, 16, 16, std::vector<float>(256, 3)))
      EXPECT_NEAR(mass, side * side / 16, kTight);
  }
}

// Σ over texels of the PDF times how often lights hold them is Σ over lights of what they hold.
TEST(KernelMasses, TheirMeanIsThatOfCoverage) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(0, 1);
  constexpr uint32_t kWidth = 37, kHeight = 50;
  std::vector<float> pdf(kWidth * kHeight);
  for (float& p : pdf) p = std::max(0.0f, place(random) - 0.2f);
  std::vector<glm::vec4> footprints;
  for (int i = 0; i < 40; ++i)
    footprints.push_back(
        {kWidth * place(random), kHeight * place(random), i % 5 == 0 ? 0 : 20 * place(random), 0});
  double sum = 0;
  for (const double mass : kernel_masses(footprints, kWidth, kHeight, pdf)) sum += mass;
  const Coverage c = cover_footprints(footprints, kWidth, kHeight, pdf);
  EXPECT_NEAR(sum / 40, 1 + *c.pdf_overlap - *c.pdf_gap, 1e-10);
}

TEST(KernelMasses, AreOfAPdf) {
  EXPECT_TRUE(kernel_masses({{1, 1, 1, 0}}, 2, 2, {}).empty());
  EXPECT_TRUE(kernel_masses({{1, 1, 1, 0}}, 2, 2, {0, 0, 0, 0}).empty());
  EXPECT_FALSE(kernels_of({.squares = {{1, 1, 1, 0}}, .clusters = {}}, 2, 2, {}).has_value());
  EXPECT_FALSE(kernels_of({.squares = {{1, 1, 0, 0}}, .clusters = {}}, 2, 2, {1, 1, 1, 1}).has_value());
  EXPECT_FALSE(kernels_of({.squares = {}, .clusters = {0, 0, 0, 0}}, 2, 2, {1, 1, 1, 1}).has_value());
}

// A light without a kernel counts in none of them, and 4 is not above 4.
TEST(KernelStats, AreOfTheLightsThatHaveAKernel) {
  std::vector<glm::vec4> footprints(6, {1, 1, 1, 0});
  footprints[1].z = 0;
  const auto stats = kernel_stats(footprints, {0.5, 1000, 4, 8, 2, 0});
  ASSERT_TRUE(stats.has_value());
  EXPECT_EQ(stats->largest, 8);
  EXPECT_DOUBLE_EQ(stats->mean, 14.5 / 5);
  EXPECT_DOUBLE_EQ(stats->over, 1.0 / 5);
  EXPECT_DOUBLE_EQ(stats->spread, (1.0 + 2 + 3 + 1) / 4);
}

TEST(Coverage, IsUndefinedWithoutShapes) { EXPECT_FALSE(coverage_of({}, 4, 2, 2, {1, 1, 1, 1}).has_value()); }

}  // namespace
}  // namespace vsglbench
