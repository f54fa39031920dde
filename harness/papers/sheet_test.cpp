#include "papers/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"

using namespace vsglbench;

namespace {

Bitmap flat(uint32_t width, uint32_t height, uint8_t value, uint32_t channels = 3) {
  Bitmap b(width, height, channels);
  std::ranges::fill(b.bytes, value);
  return b;
}

// Noise, which no PNG makes smaller.
Bitmap noise(uint32_t width, uint32_t height) {
  Bitmap b(width, height);
  uint32_t state = 1;
  for (uint8_t& byte : b.bytes) {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<uint8_t>(state >> 24);
  }
  return b;
}

TEST(Sheet, ReducingKeepsLightNotCodes) {
  Bitmap b(4, 2);  // half black, half white: the mean of the light is 0.5, encoded 188, not 128
  for (uint32_t y = 0; y < 2; ++y) {
    for (uint32_t x = 0; x < 4; x += 2) std::fill_n(b.at(x, y), 3, uint8_t{255});
  }
  const Bitmap half = reduce_to_width(b, 2);
  ASSERT_EQ(half.width, 2u);
  ASSERT_EQ(half.height, 1u);
  EXPECT_NEAR(half.at(0, 0)[0], 188, 1);
  EXPECT_NEAR(half.at(1, 0)[2], 188, 1);
}

TEST(Sheet, ReducingWeighsPixelsThatAreCutByTheirShare) {
  Bitmap b(3, 1);  // white, black, black to two: the first target has 1 of 1.5 white
  std::fill_n(b.at(0, 0), 3, uint8_t{255});
  const Bitmap two = reduce_to_width(b, 2);
  ASSERT_EQ(two.width, 2u);
  EXPECT_NEAR(two.at(0, 0)[0], encode_srgb(2.0f / 3), 1);
  EXPECT_EQ(two.at(1, 0)[0], 0);
}

TEST(Sheet, AThumbnailIsAsLargeAsItsBytesAllow) {
  const Bitmap large = noise(600, 400);
  const uint64_t limit = 100'000;
  const Bitmap small = thumbnail(large, limit);
  EXPECT_LE(encode_png(small).size(), limit);
  EXPECT_GE(encode_png(small).size(), limit / 2) << small.width;
  EXPECT_NEAR(static_cast<double>(small.width) / small.height, 1.5, 0.02);
  const Bitmap kept = thumbnail(flat(600, 400, 7), limit);
  EXPECT_EQ(kept.width, 600u);
}

TEST(Sheet, TilesKeepTheirShapeAndWrap) {
  SheetRow row{"scene", {}};
  for (int i = 0; i < 5; ++i) row.tiles.push_back({flat(100, 50, 200), "case", "SMAPE 1"});
  const Bitmap wide = draw_sheet("title", {row}, 100, 2048), narrow = draw_sheet("title", {row}, 100, 300);
  EXPECT_GT(wide.width, 500u);
  EXPECT_LE(narrow.width, 300u);
  EXPECT_GT(narrow.height, wide.height);
  // Pixels of the tiles: as many on both.
  const auto tile_pixels = [](const Bitmap& b) {
    size_t count = 0;
    for (uint32_t y = 0; y < b.height; ++y) {
      for (uint32_t x = 0; x < b.width; ++x)
        count += b.at(x, y)[0] == 200 && b.at(x, y)[1] == 200 && b.at(x, y)[2] == 200;
    }
    return count;
  };
  EXPECT_NEAR(static_cast<double>(tile_pixels(wide)), 5 * 100 * 50, 50);
  EXPECT_NEAR(static_cast<double>(tile_pixels(narrow)), 5 * 100 * 50, 50);
}

TEST(Sheet, TilesAreAsWideAsLetsTheLongestRowFit) {
  SheetRow six{"", {}}, one{"", {}};
  for (int i = 0; i < 6; ++i) six.tiles.push_back({flat(900, 30, 200), "c", ""});
  one.tiles.push_back({flat(900, 30, 200), "c", ""});
  const Bitmap sheet = draw_sheet("t", {one, six});
  EXPECT_LE(sheet.width, 2048u);
  EXPECT_GT(sheet.width, 1950u);
  EXPECT_NEAR(draw_sheet("t", {one}).width, 440, 2);
}

TEST(Sheet, SmallPicturesAreEnlargedByWholeFactorsAndAlphaIsDropped) {
  const Bitmap sheet = draw_sheet("t", {{"", {{flat(30, 30, 200, 4), "c", ""}}}}, 100, 2048);
  EXPECT_GE(sheet.width, 130u);
  EXPECT_EQ(sheet.channels, 3u);
  EXPECT_THROW(draw_sheet("t", {}, 100, 2048), Error);
  EXPECT_THROW(draw_sheet("t", {{"empty", {}}}, 100, 2048), Error);
}

}  // namespace
