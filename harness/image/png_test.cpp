#include "image/png.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>
#include <random>

#include "base/error.h"
#include "base/file.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

class Png : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_png_test_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }
};

}  // namespace

TEST_F(Png, RoundTripIsExactAtAnySize) {
  std::mt19937 random(1);
  const std::tuple<uint32_t, uint32_t, uint32_t> sizes[] = {
      {1, 1, 3}, {1, 1, 4}, {7, 3, 3}, {5, 9, 4}, {480, 272, 3}};
  for (const auto& [w, h, channels] : sizes) {
    Bitmap bitmap(w, h, channels);
    for (auto& b : bitmap.bytes) b = static_cast<uint8_t>(random());
    write_png(dir_ / "a.png", bitmap);
    const Bitmap read = read_png(dir_ / "a.png");
    EXPECT_EQ(read.width, w);
    EXPECT_EQ(read.height, h);
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.bytes, bitmap.bytes);
  }
}

TEST_F(Png, TheToneCurveIsThatOfSrgb) {
  EXPECT_EQ(encode_srgb(0), 0);
  EXPECT_EQ(encode_srgb(1), 255);
  EXPECT_EQ(encode_srgb(7), 255);
  EXPECT_EQ(encode_srgb(-1), 0);
  EXPECT_EQ(encode_srgb(0.5f), 188);   // 0.735357
  EXPECT_EQ(encode_srgb(0.18f), 118);  // 0.461356
  EXPECT_EQ(encode_srgb(0.001f), 3);   // linear part: 12.92 · 0.001 · 255 = 3.29
  const float inf = std::numeric_limits<float>::infinity();
  Image image(3, 1, glm::vec3(0.25f));
  image.pixels[1].y = inf;
  image.pixels[2].x = std::numeric_limits<float>::quiet_NaN();
  write_png(dir_ / "a.png", image, 2);
  EXPECT_EQ(read_png(dir_ / "a.png").bytes, (std::vector<uint8_t>{188, 188, 188, 255, 0, 255, 255, 0, 255}));
}

TEST_F(Png, RefusesWhatItCannotStore) {
  EXPECT_THROW(write_png(dir_ / "a.png", Bitmap()), Error);
  EXPECT_THROW(write_png(dir_ / "a.png", Bitmap(2, 2, 2)), Error);
  Bitmap short_of_bytes(4, 4);
  short_of_bytes.bytes.pop_back();
  EXPECT_THROW(write_png(dir_ / "a.png", short_of_bytes), Error);
  EXPECT_TRUE(fs::is_empty(dir_));
}

TEST_F(Png, TruncatedFilesAreErrors) {
  Bitmap bitmap(31, 17);
  std::mt19937 random(2);
  for (auto& b : bitmap.bytes) b = static_cast<uint8_t>(random());
  write_png(dir_ / "whole.png", bitmap);
  const std::string whole = read_text(dir_ / "whole.png");
  // The last 12 bytes are the end mark, after the last pixel.
  for (size_t length = 0; length + 12 < whole.size(); length += 7) {
    write_text(dir_ / "cut.png", whole.substr(0, length));
    EXPECT_THROW(read_png(dir_ / "cut.png"), Error) << length;
  }
  EXPECT_THROW(read_png(dir_ / "absent.png"), Error);
}
