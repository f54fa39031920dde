#include "lights/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Coverage, IsUndefinedWithoutShapes) { EXPECT_FALSE(coverage_of({}, 4, 2, 2, {1, 1, 1, 1}).has_value()); }

}  // namespace
}  // namespace vsglbench
