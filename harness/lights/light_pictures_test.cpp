#include "lights/light_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vsglbench {
namespace {

constexpr glm::u8vec3 kPoint{230, 159, 0};

// Eight texels a side, one footprint, a PDF on the left half. The picture stands 12 pixels from the left.
LightSet one_square() {
  LightSet set;
  set.rsm = 8;
  gpu::Vsgl l{};
  l.power = 1;
  l.diffuse = {0, 2, 1};
  l.mean = {0, 0, -2};
  l.variance = 0.01f;
  set.lights = records_of(LightKind::vsgl, std::vector{l});
  set.shapes.squares = {{2.5f, 3.5f, 3, 0}};
  for (int i = 0; i < 64; ++i) set.pdf.push_back(i % 8 < 4 ? 1.0f : 0.0f);
  return set;
}

glm::u8vec3 pixel(const Bitmap& b, uint32_t x, uint32_t y) {
  const uint8_t* p = b.at(x, y);
  return {p[0], p[1], p[2]};
}

TEST(LightPictures, ALightsColourIsItsFluxs) {
  LightSet set = one_square();
  set.lights.bytes.resize(2 * sizeof(gpu::Vsgl));  // another one, without power
  const auto marks = light_marks(set);
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_NEAR(marks[0].sigma, 0.1f, 1e-7f);
  EXPECT_EQ(marks[0].color.x, 0);
  EXPECT_EQ(marks[0].color.y, 1);
  EXPECT_NEAR(marks[0].color.z, 0.5f, 1e-6f);
  gpu::Vpl vpl{};
  vpl.power = 1;
  vpl.flux = {1, 1, 1};
  vpl.diffuse = {0.2f, 0.4f, 0};
  set = {};
  set.lights = records_of(LightKind::vpl, std::vector{vpl});
  EXPECT_EQ(light_marks(set)[0].color, glm::vec3(0.5f, 1, 0));
}

// 16 pixels a texel: the footprint's centre at texel (2.5, 3.5), the picture below two lines of captions.
TEST(LightPictures, FootprintsLieOverTheirTexels) {
  const Bitmap b = draw_on_rsm(one_square(), {}, {}, Coverage{0.5, 0.25, 0.5, 0.25}, {"a", "b"});
  EXPECT_EQ(b.width, 8u * 16 + 24);
  const uint32_t left = 12, top = 12 + 2 * 22 + 12;
  EXPECT_EQ(pixel(b, left + 40, top + 56), kPoint);
  EXPECT_GT(pixel(b, left + 4, top + 4).x, 250) << "the PDF's bright half";
  EXPECT_EQ(pixel(b, left + 100, top + 4).x, 0) << "the PDF's dark half";
  const glm::u8vec3 edge = pixel(b, left + 16, top + 60);  // x = 1: the left side of the square
  EXPECT_TRUE(edge.x < 140 && edge.z > 220) << int(edge.x) << " " << int(edge.z);
  EXPECT_EQ(pixel(b, left + 18, top + 60).z, 255) << "inside of the square's outline";
}

TEST(LightPictures, ClustersHaveBordersAndTheLightsProjections) {
  LightSet set = one_square();
  set.shapes.squares.clear();
  for (int i = 0; i < 64; ++i) set.shapes.clusters.push_back(i % 8 < 4 ? 0 : 1);
  const Bitmap b = draw_on_rsm(set, {}, {}, cover_clusters(set.shapes.clusters, 1, set.pdf), {});
  const uint32_t left = 12, top = 24;
  const glm::u8vec3 border = pixel(b, left + 63, top + 10);
  EXPECT_EQ(border, glm::u8vec3(86, 180, 233));
  EXPECT_EQ(pixel(b, left + 64, top + 64), kPoint) << "straight ahead is the middle";
}

CameraView looking_at_a_wall(float distance) {
  CameraView camera;
  camera.direct = Image(64, 36);
  for (int i = 0; i < 64 * 36; ++i) {
    camera.position.emplace_back(0, 0, -distance, 1);
    camera.normal.emplace_back(0, 0, 1, 0);
  }
  camera.view.extent = {1.6f, 0.9f};
  return camera;
}

// σ 0.1 m at 2 m, 36 pixels for 2 · 0.9 · 2 m: one pixel, 20 of the enlarged picture.
TEST(LightPictures, DisksHaveTheirProjectedSigmaAndRingsAreHidden) {
  const Bitmap seen = draw_in_scene(one_square(), looking_at_a_wall(2), {});
  ASSERT_EQ(seen.width, 64u * 20 + 24);
  const uint32_t x = 12 + 640, y = 24 + 360;
  const glm::u8vec3 wall = pixel(seen, x + 60, y), dot = pixel(seen, x, y), disk = pixel(seen, x + 8, y);
  EXPECT_EQ(dot, glm::u8vec3(0, 255, 128));
  EXPECT_GT(disk.y, wall.y + 20);
  const glm::u8vec3 ring = pixel(seen, x + 19, y), outside = pixel(seen, x + 22, y);
  EXPECT_GT(ring.y, disk.y + 20);
  EXPECT_EQ(outside, wall);
  const Bitmap hidden = draw_in_scene(one_square(), looking_at_a_wall(1.5f), {});
  EXPECT_EQ(pixel(hidden, x, y), pixel(hidden, x + 60, y)) << "a hidden light is a ring";
  EXPECT_NE(pixel(hidden, x + 19, y), pixel(hidden, x + 60, y));
  EXPECT_EQ(pixel(draw_in_scene(one_square(), looking_at_a_wall(1.95f), {}), x, y), dot)
      << "a wall less than sigma before the mean hides nothing";
}

// 2000 lights on one wall, the first 96 the strongest: the others are dots alone, and no disk covers them.
TEST(LightPictures, OfManyLightsTheStrongestAloneHaveDisks) {
  LightSet set = one_square();
  std::vector<gpu::Vsgl> lights(2000, set.lights.at<gpu::Vsgl>(0));
  for (size_t i = 0; i < lights.size(); ++i) {
    lights[i].power = i < 96 ? 2 : 1;
    lights[i].mean.x = i < 96 ? 0.3f : -0.3f;
  }
  set.lights = records_of(LightKind::vsgl, lights);
  const Bitmap b = draw_in_scene(set, looking_at_a_wall(2), {});
  const uint32_t y = 24 + 360, strong = 12 + 640 + 60, weak = 12 + 640 - 60;
  const glm::u8vec3 wall = pixel(b, 12 + 640, y);
  EXPECT_GT(pixel(b, weak, y).y, 240) << "a dot of the light's colour";
  EXPECT_NE(pixel(b, strong + 8, y), wall);
  EXPECT_EQ(pixel(b, weak + 4, y), wall) << "a weak light has a dot alone";
  EXPECT_EQ(pixel(b, weak + 19, y), wall);
  // The first light's index stands above its dot, white.
  int most = 0;
  for (uint32_t x = strong; x < strong + 16; ++x) most = std::max<int>(most, pixel(b, x, y - 10).x);
  EXPECT_GT(most, 200);
}

}  // namespace
}  // namespace vsglbench
