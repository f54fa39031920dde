#include "reference/light_guide.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsglbench {
namespace {

constexpr uint32_t kCells = LightGuide::cells, kTable = kCells * kCells;

TEST(LightGuide, SamplesFollowItsDensityAndNoCellIsForgotten) {
  LightGuide guide(20, 9);
  ASSERT_EQ(guide.tiles(), 6u);
  guide.teach(4, 5 * kCells + 7, 3);
  guide.teach(4, 31 * kCells, 1);
  for (uint32_t tile = 0; tile < 6; ++tile) guide.learn(tile);
  for (uint32_t tile = 0; tile < 6; ++tile) {
    std::vector<double> hits(kTable, 0);
    constexpr uint32_t n = 1 << 20;
    for (uint32_t i = 0; i < n; ++i) hits[guide.sample(tile, i * ((1u << 31) / n * 2) + 77)] += 1;
    double sum = 0;
    for (uint32_t c = 0; c < kTable; ++c) {
      EXPECT_GE(guide.density(tile, c), 0.25f);
      EXPECT_NEAR(hits[c] / n * kTable, guide.density(tile, c), 1e-3 * guide.density(tile, c))
          << tile << " " << c;
      sum += guide.density(tile, c);
    }
    EXPECT_NEAR(sum, kTable, 1e-2);
  }
  EXPECT_GT(guide.density(4, 5 * kCells + 7), 100);
  EXPECT_GT(guide.density(4, 5 * kCells + 7), 2.5f * guide.density(4, 31 * kCells));
}

TEST(LightGuide, CellsAndColumnsAndRowsBelongTogether) {
  for (uint32_t c = 0; c < kTable; ++c) {
    EXPECT_EQ(LightGuide::cell(LightGuide::column_row(c)), c);
    EXPECT_EQ(LightGuide::cell((glm::vec2(LightGuide::column_row(c)) + 0.5f) / float(kCells)), c);
  }
  EXPECT_EQ(LightGuide::column_row(LightGuide::cell(glm::vec2(1, 0))), glm::uvec2(kCells - 1, 0));
}

TEST(LightGuide, IsUniformBeforeItLearns) {
  LightGuide guide(8, 8);
  guide.learn(0);  // taught nothing
  for (uint32_t c = 0; c < kTable; ++c) EXPECT_FLOAT_EQ(guide.density(0, c), 1);
  EXPECT_EQ(guide.tile(7, 7), 0u);
}

}  // namespace
}  // namespace vsglbench
