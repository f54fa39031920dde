#include "image/draw.h"

#include <gtest/gtest.h>

#include <numeric>

namespace vsglbench {
namespace {

constexpr double kPi = 3.14159265358979;

// Sum of the red channel as a share of white.
double amount(const Bitmap& b) {
  double sum = 0;
  for (size_t i = 0; i < b.bytes.size(); i += b.channels) sum += b.bytes[i];
  return sum / 255;
}

TEST(Draw, RectangleAndOutlineAreCut) {
  Bitmap b(8, 6);
  fill_rectangle(b, {-3, 4}, {2, 90}, {glm::u8vec3(255), 1});
  EXPECT_EQ(amount(b), 4);
  Bitmap outline(8, 8);
  outline_rectangle(outline, {1, 1}, {6, 5}, {glm::u8vec3(255), 0.5f});
  EXPECT_NEAR(amount(outline), 0.5 * (5 * 4 - 3 * 2), 0.1) << "a corner is drawn twice";
  EXPECT_EQ(*outline.at(2, 2), 0);
  outline_rectangle(outline, {-9, -9}, {99, 99}, {glm::u8vec3(255), 1});
  EXPECT_EQ(*outline.at(0, 0), 0) << "an edge outside of the bitmap is drawn inside";
}

TEST(Draw, DisksHaveTheirArea) {
  for (const double radius : {1.5, 4.0, 10.3}) {
    Bitmap filled(40, 40), ring(40, 40);
    fill_disk(filled, {19.7, 20.2}, radius, {});
    outline_disk(ring, {19.7, 20.2}, radius, 1, {});
    EXPECT_NEAR(amount(filled), kPi * radius * radius, 0.4) << "radius " << radius;
    const double inner = radius - 1;
    EXPECT_NEAR(amount(ring), kPi * (radius * radius - inner * inner), 0.4);
    EXPECT_EQ(*filled.at(20, 20), 255);
    EXPECT_TRUE(radius < 2 || *ring.at(19, 20) == 0) << "a ring is hollow";
  }
}

TEST(Draw, HugeDisksAndFarOnesAreCut) {
  Bitmap b(8, 8);
  fill_disk(b, {1e12, -1e12}, 5, {});
  EXPECT_EQ(amount(b), 0);
  fill_disk(b, {4, 4}, 1e12, {});
  EXPECT_EQ(amount(b), 64);
}

}  // namespace
}  // namespace vsglbench
