#include "lights/moment_pictures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shaders/types.h"

namespace vsglbench {
namespace {

using Color = glm::u8vec3;

// Where the sheet without captions has its panels, of small RSMs: two beside each other, 480 pixels wide and
// 12 apart, a line of 22 for each one's title.
struct Sheet {
  Bitmap bitmap;
  uint32_t panel_height;
  // The middle of a texel of 16 × 16 pixels in panel `k`, whose level stands at `place`.
  Color texel(uint32_t k, glm::uvec2 place, uint32_t x, uint32_t y) const {
    const uint32_t left = 12 + k % 2 * (480 + 12), top = 24 + k / 2 * (22 + panel_height + 12) + 22;
    const uint8_t* p = bitmap.at(left + place.x + 16 * x + 8, top + place.y + 16 * y + 8);
    return {p[0], p[1], p[2]};
  }
};

// One white texel of power 1 at (1, 2) of level 0, and on each coarser level the one that covers it.
MipmappedRsm one_lit(uint32_t size) {
  MipmappedRsm rsm{.lobes = DIFFUSE_LOBE | SPECULAR_LOBE};
  for (uint32_t level = 0, side = size;; ++level, side = (side + 1) / 2) {
    MomentLevel l{side, side, std::vector<MomentTexel>(size_t(side) * side)};
    MomentTexel& t = l.texels[(2u >> level) * side + (1u >> level)];
    t.diffuse = glm::vec3(std::exp2(-2.0f * static_cast<float>(level)));
    t.specular = glm::vec3(0.01f, 0, 0) * t.diffuse;
    t.diffuse_direction = {0, 2.0f / 3, 0};
    t.specular_direction = {-1, 0, 0};
    t.position = {0.5f, -1, 1};
    t.square = 1.5;
    rsm.levels.push_back(std::move(l));
    if (side == 1) return rsm;
  }
}

const SceneBox kBox{{0, 0, 0}, {-1, -1, -1}, {1, 1, 1}};

TEST(MomentPictures, APanelHasTheLevelsOfItsMomentInItsColours) {
  const Sheet sheet{draw_moments(one_lit(4), kBox, {}), 64};
  ASSERT_EQ(sheet.bitmap.width, 2u * 480 + 12 + 24);
  const std::vector<glm::uvec2> places = {{0, 0}, {66, 0}, {66, 34}};
  // 0.8 where the power is 1, and a quarter of that from level to level, by the sRGB curve.
  EXPECT_EQ(sheet.texel(0, places[0], 1, 2), Color(231));
  EXPECT_EQ(sheet.texel(0, places[1], 0, 1), Color(124));
  EXPECT_EQ(sheet.texel(0, places[2], 0, 0), Color(63));
  // The same exposure in luminance for the dark specular lobe, which is red.
  EXPECT_EQ(sheet.texel(1, places[0], 1, 2), Color(255, 0, 0));
  const Color expected[] = {{}, {}, {128, 213, 128}, {0, 128, 128}, {191, 0, 255}, {128, 128, 128}};
  for (uint32_t panel = 2; panel < 6; ++panel) {
    EXPECT_EQ(sheet.texel(panel, places[0], 1, 2), expected[panel]) << panel;
    EXPECT_EQ(sheet.texel(panel, places[1], 0, 1), expected[panel]) << panel;
    EXPECT_EQ(sheet.texel(panel, places[2], 0, 0), expected[panel]) << panel;
  }
  for (uint32_t panel = 0; panel < 6; ++panel) {
    EXPECT_EQ(sheet.texel(panel, places[0], 2, 1), Color(0)) << panel;
    EXPECT_EQ(sheet.texel(panel, places[1], 1, 0), Color(0)) << panel;
  }
}

// Of 5 texels a side: 3 + 2 + 1 below each other are more than 5.
TEST(MomentPictures, LevelsOfOddSizesHaveRoom) {
  const Sheet sheet{draw_moments(one_lit(5), kBox, {}), 100};
  const std::vector<glm::uvec2> places = {{0, 0}, {82, 0}, {82, 50}, {82, 84}};
  EXPECT_EQ(sheet.texel(4, places[0], 1, 2), Color(191, 0, 255));
  EXPECT_EQ(sheet.texel(4, places[1], 0, 1), Color(191, 0, 255));
  EXPECT_EQ(sheet.texel(4, places[1], 2, 2), Color(0));
  EXPECT_EQ(sheet.texel(4, places[2], 0, 0), Color(191, 0, 255));
  EXPECT_EQ(sheet.texel(4, places[2], 1, 1), Color(0));
  EXPECT_EQ(sheet.texel(4, places[3], 0, 0), Color(191, 0, 255));
}

TEST(MomentPictures, ALobeThatLightsDoNotHaveHasNoPanels) {
  MipmappedRsm rsm = one_lit(4);
  const uint32_t both = draw_moments(rsm, kBox, {}).height;
  rsm.lobes = DIFFUSE_LOBE;
  const Sheet sheet{draw_moments(rsm, kBox, {}), 64};
  // A row of panels less, and a line that says so.
  EXPECT_EQ(sheet.bitmap.height, both - (22 + 64 + 12) + 22);
  EXPECT_EQ(sheet.texel(1, {0, 0}, 1, 2), Color(128, 213, 128));
  EXPECT_EQ(sheet.texel(2, {0, 0}, 1, 2), Color(191, 0, 255));
}

// 512 texels a side are one panel wide; of 1024 the finest level has no room.
TEST(MomentPictures, NoSheetIsWiderThan1100Pixels) {
  const MipmappedRsm one_texel{DIFFUSE_LOBE | SPECULAR_LOBE, {one_lit(4).levels.back()}};
  EXPECT_EQ(draw_moments(one_texel, kBox, {}).width, 996u);
  EXPECT_EQ(draw_moments(one_lit(256), kBox, {}).width, 996u);
  EXPECT_EQ(draw_moments(one_lit(340), kBox, {}).width, 2u * (340 + 2 + 170) + 12 + 24);
  EXPECT_EQ(draw_moments(one_lit(512), kBox, {}).width, 512u + 2 + 256 + 24);
  EXPECT_EQ(draw_moments(one_lit(1024), kBox, {}).width, 512u + 2 + 256 + 24);
}

}  // namespace
}  // namespace vsglbench
