#include "run/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vsglbench {
namespace {

constexpr double kTight = 1e-12;

TEST(Coverage, NoLightIsAllGap) {
  for (const auto& squares : {std::vector<glm::vec4>{}, std::vector<glm::vec4>{{2, 2, 0, 0}}}) {
    const Coverage c = cover_squares(squares, 4, 4, {});
    EXPECT_EQ(c.overlap, 0);
    EXPECT_EQ(c.gap, 1);
    EXPECT_FALSE(c.pdf_overlap || c.pdf_gap);
  }
}

TEST(Coverage, TilesLeaveNothingAndShareNothing) {
  std::vector<glm::vec4> tiles;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) tiles.push_back({1.5 + 3 * x, 1.5 + 3 * y, 3, 0});
  }
  const Coverage c = cover_squares(tiles, 12, 12, std::vector<float>(144, 0.25f));
  EXPECT_NEAR(c.overlap, 0, kTight);
  EXPECT_NEAR(c.gap, 0, kTight);
  EXPECT_NEAR(*c.pdf_overlap, 0, kTight);
  EXPECT_NEAR(*c.pdf_gap, 0, kTight);
}

// Two squares of side 1.5 a quarter apart, one of them over the corner, and a third thrice on a place of its
// own.
TEST(Coverage, CountsLightsBeyondTheFirst) {
  const std::vector<glm::vec4> squares = {
      {0.5, 0.5, 1.5, 0}, {0.75, 0.75, 1.5, 0}, {3, 3, 1, 0}, {3, 3, 1, 0}, {3, 3, 1, 0}};
  const Coverage c = cover_squares(squares, 4, 4, {});
  const double first = 1.25 * 1.25, second = 1.5 * 1.5, both = 1.25 * 1.25;
  EXPECT_NEAR(c.overlap, (both + 2) / 16, kTight);
  EXPECT_NEAR(c.gap, (16 - (first + second - both) - 1) / 16, kTight);
}

// Rows and columns of the PDF that differ: a mistake of axis, or of the clipping, shows.
TEST(Coverage, WeighsPointsByThePdf) {
  const std::vector<float> pdf = {1, 2, 0, 4, 8, 0};  // 3 × 2 texels
  const std::vector<glm::vec4> squares = {{0.5, 0.5, 1, 0}, {0.5, 1, 1, 0}, {2.75, 1, 2, 0}};
  const Coverage c = cover_squares(squares, 3, 2, pdf);
  // Covered: column 0 from y = 0 to 1.5, twice from 0.5 to 1; columns from 1.75 on, all rows.
  EXPECT_NEAR(*c.pdf_overlap, 0.5 * 1 / 15, kTight);
  EXPECT_NEAR(*c.pdf_gap, (0.5 * 4 + 0.75 * (2 + 8)) / 15, kTight);
  EXPECT_NEAR(c.gap, (0.5 + 0.75 * 2) / 6, kTight);
  EXPECT_FALSE(cover_squares(squares, 3, 2, std::vector<float>(6, 0)).pdf_gap);
}

// Against counting at the centres of a finer grid, on which all edges lie.
TEST(Coverage, AgreesWithCounting) {
  constexpr int kSize = 24, kFine = 8;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(0, kSize * kFine), side(0, 6 * kFine);
  std::vector<glm::vec4> squares;
  for (int i = 0; i < 120; ++i) {
    squares.push_back(glm::vec4(place(random), place(random), 2 * (side(random) / 2), 0) / float(kFine));
  }
  std::vector<float> pdf;
  for (int i = 0; i < kSize * kSize; ++i)
    pdf.push_back(static_cast<float>(std::pow(10, -3.0 * (i * 7 % 11) / 10)));
  double overlap = 0, gap = 0, pdf_overlap = 0, pdf_gap = 0, pdf_all = 0;
  for (int y = 0; y < kSize * kFine; ++y) {
    for (int x = 0; x < kSize * kFine; ++x) {
      const double u = (x + 0.5) / kFine, v = (y + 0.5) / kFine;
      int count = 0;
      for (const auto& s : squares) count += std::abs(u - s.x) < 0.5 * s.z && std::abs(v - s.y) < 0.5 * s.z;
      const double p = pdf[size_t(y / kFine * kSize + x / kFine)];
      overlap += std::max(count - 1, 0);
      gap += count == 0;
      pdf_overlap += p * std::max(count - 1, 0);
      pdf_gap += p * (count == 0);
      pdf_all += p;
    }
  }
  const double points = kSize * kFine * kSize * kFine;
  const Coverage c = cover_squares(squares, kSize, kSize, pdf);
  EXPECT_GT(gap, 0.05 * points) << "the squares leave nothing to be found";
  EXPECT_NEAR(c.overlap, overlap / points, 1e-11);
  EXPECT_NEAR(c.gap, gap / points, 1e-11);
  EXPECT_NEAR(*c.pdf_overlap, pdf_overlap / pdf_all, 1e-11);
  EXPECT_NEAR(*c.pdf_gap, pdf_gap / pdf_all, 1e-11);
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
