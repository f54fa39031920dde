#include "image/crop.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

using namespace vsglbench;

TEST(Crop, TheWorstIsTheLargestSumOfAll) {
  std::mt19937 random(1);
  const std::tuple<uint32_t, uint32_t, uint32_t> sizes[] = {{1, 1, 64}, {7, 3, 2}, {23, 19, 5}, {40, 4, 8}};
  for (const auto& [w, h, side] : sizes) {
    std::vector<double> map(size_t(w) * h);
    for (double& v : map) v = static_cast<double>(random() % 1000);  // whole numbers: sums are exact
    const Crop got = worst_crop(map, w, side);
    EXPECT_EQ(got.width, std::min(w, side));
    EXPECT_EQ(got.height, std::min(h, side));
    double largest = -1;
    Crop want;
    for (uint32_t y = 0; y + got.height <= h; ++y) {
      for (uint32_t x = 0; x + got.width <= w; ++x) {
        double sum = 0;
        for (uint32_t v = 0; v < got.height; ++v)
          for (uint32_t u = 0; u < got.width; ++u) sum += map[size_t(y + v) * w + x + u];
        if (sum > largest) largest = sum, want = {x, y, got.width, got.height};
      }
    }
    EXPECT_EQ(got, want) << w << "x" << h;
  }
}

TEST(Crop, HoldsAPlantedSpot) {
  std::vector<double> map(480 * 272, 0.01);
  map[200 * 480 + 471] = 1000;  // near the right edge
  const Crop c = worst_crop(map, 480, 64);
  EXPECT_EQ(c.width, 64u);
  EXPECT_LE(c.x, 471u);
  EXPECT_LE(c.x + c.width, 480u);
  EXPECT_TRUE(c.y <= 200 && 200 < c.y + c.height);
  EXPECT_EQ(worst_crop(std::vector<double>(480 * 272, 0.0), 480, 64), (Crop{0, 0, 64, 64}));
}

TEST(Crop, CutsThatPart) {
  Image image(5, 4);
  Mask mask(20);
  for (int i = 0; i < 20; ++i) image.pixels[i] = glm::vec3(static_cast<float>(i)), mask[i] = i % 3 == 0;
  const Image part = crop_image(image, {2, 1, 3, 2});
  const Mask kept = crop_mask(mask, 5, {2, 1, 3, 2});
  const int want[6] = {7, 8, 9, 12, 13, 14};
  ASSERT_EQ(part.pixels.size(), 6u);
  EXPECT_EQ(part.width, 3u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(part.pixels[i].x, static_cast<float>(want[i]));
    EXPECT_EQ(kept[i], want[i] % 3 == 0);
  }
  EXPECT_TRUE(crop_mask({}, 5, {2, 1, 3, 2}).empty());
}

TEST(Crop, RefusesWhatReachesOut) {
  const Image image(5, 4);
  for (const Crop& c : {Crop{0, 0, 6, 1}, Crop{3, 0, 3, 1}, Crop{0, 3, 1, 2}, Crop{0, 0, 0, 1},
                        Crop{5, 0, 1, 1}, Crop{4000000000u, 0, 1000000000u, 1}}) {
    EXPECT_THROW(crop_image(image, c), std::logic_error);
    EXPECT_THROW(crop_mask(Mask(20), 5, c), std::logic_error);
  }
  EXPECT_THROW(worst_crop({}, 5, 1), std::logic_error);
  EXPECT_THROW(worst_crop(std::vector<double>(7), 5, 1), std::logic_error);
  EXPECT_THROW(worst_crop(std::vector<double>(5), 5, 0), std::logic_error);
}
