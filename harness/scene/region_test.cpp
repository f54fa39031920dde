#include "scene/region.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

using namespace vsglbench;

namespace {

bool holds(const Region& r, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  const double u = (x + 0.5) / width, v = (y + 0.5) / height;
  return r.x0 <= u && u < r.x1 && r.y0 <= v && v < r.y1;
}

}  // namespace

TEST(Region, ItsPixelsAreThoseWhoseCentresItHolds) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> share;
  size_t empty = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto width = static_cast<uint32_t>(1 + random() % 40),
               height = static_cast<uint32_t>(1 + random() % 9);
    Region r{share(random), share(random), share(random), share(random)};
    if (r.x0 > r.x1) std::swap(r.x0, r.x1);
    if (r.y0 > r.y1) std::swap(r.y0, r.y1);
    const auto crop = pixels_of(r, width, height);
    size_t held = 0;
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        const bool inside =
            crop && x >= crop->x && x < crop->x + crop->width && y >= crop->y && y < crop->y + crop->height;
        EXPECT_EQ(inside, holds(r, x, y, width, height)) << x << ' ' << y;
        held += inside;
      }
    }
    EXPECT_EQ(crop.has_value(), held > 0);
    empty += !crop;
  }
  EXPECT_GT(empty, 0u);
  EXPECT_LT(empty, 500u);
}

TEST(Region, TheWholeFrameIsAllOfIt) {
  EXPECT_EQ(pixels_of({}, 480, 272), (Crop{0, 0, 480, 272}));
  EXPECT_EQ(pixels_of({0.25, 0.5, 1, 1}, 480, 272), (Crop{120, 136, 360, 136}));
}

// Halves of an odd number of pixels: the one in the middle is in the second.
TEST(Region, NeighboursShareNoPixel) {
  EXPECT_EQ(pixels_of({0, 0, 0.5, 1}, 5, 1), (Crop{0, 0, 2, 1}));
  EXPECT_EQ(pixels_of({0.5, 0, 1, 1}, 5, 1), (Crop{2, 0, 3, 1}));
}
