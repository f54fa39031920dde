#include "image/temporal_profile.h"

#include <gtest/gtest.h>

#include "base/error.h"

using namespace vsglbench;

namespace {

uint64_t count_color(const Bitmap& bitmap, glm::u8vec3 color) {
  uint64_t n = 0;
  for (size_t i = 0; i < bitmap.bytes.size(); i += 3) {
    n += bitmap.bytes[i] == color.x && bitmap.bytes[i + 1] == color.y && bitmap.bytes[i + 2] == color.z;
  }
  return n;
}

// A row of 0.25 … of x and t, which only row 2 has.
Image frame(uint32_t w, uint32_t h, float value) {
  Image image(w, h, glm::vec3(9));
  for (uint32_t x = 0; x < w; ++x) image.at(x, 2) = glm::vec3(value, static_cast<float>(x), 0);
  return image;
}

}  // namespace

TEST(TemporalProfile, StacksOneRow) {
  TemporalProfile profile({.title = "t", .row = 2, .exposure = 1});
  for (uint32_t t = 0; t < 5; ++t)
    profile.add(frame(7, 3, static_cast<float>(t)), frame(7, 3, static_cast<float>(10 * t)));
  const Image x = profile.test(), r = profile.reference();
  ASSERT_EQ(x.width, 7u);
  ASSERT_EQ(x.height, 5u);
  ASSERT_EQ(r.pixels.size(), 35u);
  for (uint32_t t = 0; t < 5; ++t) {
    for (uint32_t u = 0; u < 7; ++u) {
      EXPECT_EQ(x.at(u, t), glm::vec3(static_cast<float>(t), static_cast<float>(u), 0));
      EXPECT_EQ(r.at(u, t), glm::vec3(static_cast<float>(10 * t), static_cast<float>(u), 0));
    }
  }
}

TEST(TemporalProfile, DrawsEveryPixelInBothPanels) {
  // 480 columns once, 16 frames 15 times each; 1 column 400 times, 40 frames 6 times; 1920 columns above each
  // other.
  const std::tuple<uint32_t, uint32_t, uint64_t, uint64_t> cases[] = {
      {480, 16, 1, 15}, {1, 40, 400, 6}, {1920, 16, 1, 15}, {7, 1, 58, 16}, {33, 500, 13, 1}};
  for (const auto& [w, frames, across, down] : cases) {
    TemporalProfile profile({.title = "a title", .row = 0, .exposure = 0.5f});
    for (uint32_t t = 0; t < frames; ++t)
      profile.add(Image(w, 1, glm::vec3(0.5f)), Image(w, 1, glm::vec3(1, 0, 0)));
    const Bitmap b = profile.draw();
    EXPECT_EQ(count_color(b, glm::u8vec3(encode_srgb(0.25f))), w * frames * across * down) << w;
    EXPECT_EQ(count_color(b, {encode_srgb(0.5f), 0, 0}), w * frames * across * down) << w;
    EXPECT_LE(b.width, 2200u);
  }
}

TEST(TemporalProfile, RefusesWhatDoesNotFit) {
  TemporalProfile profile({.title = "", .row = 2, .exposure = 1});
  EXPECT_THROW(profile.draw(), Error);
  EXPECT_THROW(profile.add(Image(4, 2), Image(4, 2)), Error) << "no such row";
  EXPECT_THROW(profile.add(Image(4, 3), Image(4, 4)), Error);
  profile.add(Image(4, 3), Image(4, 3));
  EXPECT_THROW(profile.add(Image(5, 3), Image(5, 3)), Error);
  EXPECT_THROW(profile.add(Image(4, 4), Image(4, 4)), Error);
  EXPECT_EQ(profile.test().height, 1u);
  profile.draw();
}
