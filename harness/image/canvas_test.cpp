#include "image/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr double kPi = 3.14159265358979;

// Sum of the red channel as a share of white.
double amount(const Canvas& canvas) {
  const Bitmap b = canvas.bitmap();
  double sum = 0;
  for (size_t i = 0; i < b.bytes.size(); i += b.channels) sum += b.bytes[i];
  return sum / 255;
}

int red(const Canvas& canvas, uint32_t x, uint32_t y) { return *canvas.bitmap().at(x, y); }

TEST(Canvas, RectangleAndOutlineAreCut) {
  Canvas filled(8, 6, glm::u8vec3(0));
  filled.fill_rectangle({-3, 4}, {2, 90}, {});
  EXPECT_EQ(amount(filled), 4);
  Canvas outline(8, 8, glm::u8vec3(0));
  outline.outline_rectangle({1, 1}, {6, 5}, 1, {glm::u8vec3(255), 0.5f});
  EXPECT_NEAR(amount(outline), 0.5 * (5 * 4 - 3 * 2), 0.1) << "a corner is drawn twice";
  EXPECT_EQ(red(outline, 2, 2), 0);
  outline.outline_rectangle({-9, -9}, {99, 99}, 1, {});
  EXPECT_EQ(red(outline, 0, 0), 0) << "an edge outside of the picture is drawn inside";
}

TEST(Canvas, DisksHaveTheirArea) {
  for (const double radius : {1.5, 4.0, 10.3}) {
    Canvas filled(40, 40, glm::u8vec3(0)), ring(40, 40, glm::u8vec3(0));
    filled.fill_disk({19.7, 20.2}, radius, {});
    ring.outline_disk({19.7, 20.2}, radius, 1, {});
    EXPECT_NEAR(amount(filled), kPi * radius * radius, 0.01 * kPi * radius * radius) << "radius " << radius;
    const double inner = radius - 1, area = kPi * (radius * radius - inner * inner);
    EXPECT_NEAR(amount(ring), area, 0.02 * area);
    EXPECT_EQ(red(filled, 20, 20), 255);
    EXPECT_TRUE(radius < 2 || red(ring, 19, 20) == 0) << "a ring is hollow";
  }
}

TEST(Canvas, HugeDisksAndFarOnesAreCut) {
  Canvas canvas(8, 8, glm::u8vec3(0));
  canvas.fill_disk({1e12, -1e12}, 5, {});
  EXPECT_EQ(amount(canvas), 0);
  canvas.fill_disk({4, 4}, 1e12, {});
  EXPECT_EQ(amount(canvas), 64);
}

TEST(Canvas, KeepsAPictureAsItIs) {
  Bitmap picture(5, 3);
  for (size_t i = 0; i < picture.bytes.size(); ++i) picture.bytes[i] = static_cast<uint8_t>(17 * i);
  EXPECT_EQ(Canvas(picture).bitmap().bytes, picture.bytes);
  Canvas larger(6, 6, glm::u8vec3(9));
  larger.picture(4, 4, picture);  // cut at both edges
  EXPECT_EQ(*larger.bitmap().at(4, 4), picture.bytes[0]);
  EXPECT_EQ(*larger.bitmap().at(3, 4), 9);
}

TEST(Canvas, WritesTextInsideOfItsBox) {
  const Font font(20);
  Canvas canvas(200, 60, glm::u8vec3(0));
  canvas.text({10, 10}, "Ångström pgq", font, {});
  const Bitmap b = canvas.bitmap();
  EXPECT_GT(amount(canvas), 100);
  const double right = 10 + font.width("Ångström pgq");
  for (uint32_t y = 0; y < b.height; ++y) {
    for (uint32_t x = 0; x < b.width; ++x) {
      if (y < 10 || y >= 10 + 1.3 * 20 || x < 10 || x > right + 1) {
        EXPECT_EQ(*b.at(x, y), 0) << x << " " << y;
      }
    }
  }
  Canvas halo(200, 60, glm::u8vec3(128));
  halo.text({10, 10}, "x", font, {}, glm::u8vec3(0));
  const std::vector<uint8_t> bytes = halo.bitmap().bytes;
  EXPECT_LT(*std::ranges::min_element(bytes), 20) << "the rim";
  EXPECT_GT(*std::ranges::max_element(bytes), 235) << "the sign";
}

TEST(Canvas, RefusesASizeThatItCannotHave) {
  EXPECT_THROW(Canvas(0, 5, glm::u8vec3(0)), Error);
  EXPECT_THROW(Canvas(40000, 5, glm::u8vec3(0)), Error);
}

}  // namespace
}  // namespace vsglbench
