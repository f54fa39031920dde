#include "image/flicker_picture.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "image/error_map.h"
#include "image/theme.h"

using namespace vsglbench;

namespace {

uint64_t count_color(const Bitmap& bitmap, glm::u8vec3 color) {
  uint64_t n = 0;
  for (size_t i = 0; i < bitmap.bytes.size(); i += 3) {
    n += bitmap.bytes[i] == color.x && bitmap.bytes[i + 1] == color.y && bitmap.bytes[i + 2] == color.z;
  }
  return n;
}

glm::u8vec3 gray(float radiance) { return glm::u8vec3(encode_srgb(radiance)); }

constexpr uint64_t kTile = 256 * 256;

FlickerPictureOptions options(Crop crop, uint32_t frames = 3) {
  return {.title = "scene  method",
          .crop = crop,
          .frames = frames,
          .exposure = 0.5f,
          .mean_reference = 2,
          .range = 0.5f};
}

}  // namespace

TEST(FlickerPicture, HasTestReferenceAndChangeOfTheCrop) {
  const Crop crop{8, 4, 64, 64};
  FlickerPicture picture(options(crop));
  Image r(100, 80, glm::vec3(1)), x(100, 80, glm::vec3(0.5f));
  const Bitmap first = picture.draw(x, r);
  EXPECT_EQ(count_color(first, gray(0.25f)), kTile) << "test";
  EXPECT_EQ(count_color(first, gray(0.5f)), kTile) << "reference";
  EXPECT_EQ(count_color(first, theme().no_surface), kTile) << "nothing came before the first frame";

  // x rises by 0.7, r by 0.2: 0.5 / 2 of a range of 0.5. Outside of the crop nothing is drawn.
  for (auto& p : x.pixels) p += 0.7f;
  for (auto& p : r.pixels) p += 0.2f;
  x.at(7, 4) = x.at(72, 4) = x.at(8, 3) = x.at(8, 68) = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const Bitmap second = picture.draw(x, r);
  EXPECT_EQ(count_color(second, gray(0.6f)), 2 * kTile) << "the same exposure in all frames";
  EXPECT_GE(count_color(second, diverging_color(0.5f)), kTile);
  EXPECT_EQ(count_color(second, {255, 0, 255}), 0u);
  EXPECT_EQ(second.width, first.width);
  EXPECT_EQ(second.height, first.height);
}

TEST(FlickerPicture, ChangesCountWhereBothFramesShowASurface) {
  FlickerPicture picture(options({0, 0, 2, 2}));
  const Image r(2, 2, glm::vec3(1));
  picture.draw(r, r, {1, 0, 1, 1});
  const Bitmap b = picture.draw(r, r, {1, 1, 0, 1});
  EXPECT_EQ(count_color(b, theme().no_surface), kTile / 2);
  EXPECT_GE(count_color(b, diverging_color(0)), kTile / 2);
}

TEST(FlickerPicture, TakesAnySize) {
  for (const auto& [w, h] : {std::pair{1u, 1u}, {7u, 3u}, {1u, 300u}, {300u, 1u}, {640u, 480u}}) {
    FlickerPicture picture(options({0, 0, w, h}));
    const Image r(w, h, glm::vec3(1));
    picture.draw(r, r);
    const Bitmap b = picture.draw(r, r);
    EXPECT_GE(b.width, 3 * 256u);
    EXPECT_LE(b.width, 2048u);
    EXPECT_LE(b.height, 1200u);
  }
}

TEST(FlickerPicture, RefusesWhatIsNoPicture) {
  const Image r(4, 4, glm::vec3(1));
  EXPECT_THROW(FlickerPicture(options({0, 0, 0, 4})), std::logic_error);
  EXPECT_THROW(FlickerPicture(options({0, 0, 4, 4}, 0)), std::logic_error);
  FlickerPictureOptions black = options({0, 0, 4, 4});
  black.mean_reference = 0;
  EXPECT_THROW(FlickerPicture{black}, std::logic_error);
  EXPECT_THROW(FlickerPicture(options({1, 0, 4, 4})).draw(r, r), std::logic_error);
  EXPECT_THROW(FlickerPicture(options({0, 0, 4, 4})).draw(r, Image(4, 5)), Error);
  EXPECT_THROW(FlickerPicture(options({0, 0, 4, 4})).draw(r, r, Mask(3)), Error);
}
