#include "image/exr.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/file.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

class Exr : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_exr_test_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }
  void write(const fs::path& path, std::vector<uint8_t> bytes) {
    write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
};

// Random bit patterns, infinities, NaN and denormals among them: nothing may change on the way.
Image random_bits(uint32_t w, uint32_t h, uint32_t seed) {
  std::mt19937 random(seed);
  Image image(w, h);
  for (auto& p : image.pixels) {
    for (int c = 0; c < 3; ++c) p[c] = std::bit_cast<float>(static_cast<uint32_t>(random()));
  }
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

std::string message_of(const fs::path& path) {
  try {
    read_exr_layers(path);
  } catch (const Error& e) {
    EXPECT_EQ(e.exit_code(), 2);
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_F(Exr, RoundTripIsExactAtAnySize) {
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 1}, {1, 7}, {7, 1}, {33, 17}, {480, 272}, {3, 129}};
  for (const auto& [w, h] : sizes) {
    const Image image = random_bits(w, h, w * 1000 + h);
    write_exr(dir_ / "a.exr", image);
    EXPECT_TRUE(same_bits(read_exr(dir_ / "a.exr"), image)) << w << "x" << h;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_), {}), 1) << "no litter";
}

TEST_F(Exr, LayersKeepTheirNames) {
  ExrLayers layers{
      5,
      3,
      {{"", random_bits(5, 3, 1)}, {"half0", random_bits(5, 3, 2)}, {"half1", random_bits(5, 3, 3)}},
      {{"variance", std::vector<float>(15, 0.25f)}, {"half0.depth", std::vector<float>(15, 7)}},
      {{"hash", "0123abc"}}};
  write_exr(dir_ / "layers.exr", layers);
  const ExrLayers read = read_exr_layers(dir_ / "layers.exr");
  ASSERT_EQ(read.colors.size(), 3u);
  for (const auto& [name, image] : layers.colors) EXPECT_TRUE(same_bits(read.colors.at(name), image)) << name;
  EXPECT_EQ(read.scalars, layers.scalars);
  EXPECT_EQ(read.attributes.at("hash"), "0123abc");
  EXPECT_TRUE(same_bits(read_exr(dir_ / "layers.exr"), layers.colors.at("")));
}

// A half float has 11 significant bits: half a step is 2^-11 of the value.
TEST_F(Exr, HalfFloatsAreTheNearest) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-12, 15), sign(-1, 1);
  Image image(13, 7);
  for (auto& p : image.pixels) {
    for (int c = 0; c < 3; ++c) p[c] = std::copysign(std::exp2(exponent(random)), sign(random));
  }
  image.at(0, 0) = glm::vec3(1e9f, -std::numeric_limits<float>::infinity(), 0);
  write_text(dir_ / "half.exr", encode_half_exr(image));
  const Image back = read_exr(dir_ / "half.exr");
  ASSERT_EQ(back.width, 13);
  ASSERT_EQ(back.height, 7);
  EXPECT_EQ(back.at(0, 0), glm::vec3(65504, -65504, 0));
  for (size_t i = 1; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float v = image.pixels[i][c];
      EXPECT_LE(std::abs(back.pixels[i][c] - v), std::abs(v) / 2048) << v;
    }
  }
  EXPECT_THROW(encode_half_exr(Image()), std::runtime_error);
  std::vector<float> alpha(image.pixels.size(), 1);
  alpha[5] = 0;
  write_text(dir_ / "covered.exr", encode_half_exr(image, alpha));
  EXPECT_EQ(read_exr_layers(dir_ / "covered.exr").scalars.at("A"), alpha);
  EXPECT_TRUE(same_bits(read_exr(dir_ / "covered.exr"), back));
}

TEST_F(Exr, RowsRunFromTheTop) {
  Image image(2, 2);
  image.at(1, 0) = {1, 2, 3};
  write_exr(dir_ / "a.exr", image);
  EXPECT_EQ(read_exr(dir_ / "a.exr").at(1, 0), glm::vec3(1, 2, 3));
}

TEST_F(Exr, RefusesWhatItCannotStore) {
  EXPECT_THROW(write_exr(dir_ / "a.exr", Image()), Error);
  EXPECT_THROW(write_exr(dir_ / "a.exr", ExrLayers{2, 2, {{"x", Image(2, 3)}}, {}, {}}), Error);
  EXPECT_THROW(write_exr(dir_ / "a.exr", ExrLayers{2, 2, {}, {{"x", {1, 2, 3}}}, {}}), Error);
  EXPECT_THROW(write_exr(dir_ / "a.exr", ExrLayers{2, 2, {}, {}, {}}), Error);
  EXPECT_THROW(write_exr("/proc/vsglbench/a.exr", Image(1, 1)), Error);
  EXPECT_TRUE(fs::is_empty(dir_));
}

TEST_F(Exr, AMissingColourIsAnError) {
  write_exr(dir_ / "a.exr", ExrLayers{1, 1, {}, {{"Z", {1}}}, {}});
  EXPECT_THROW(read_exr(dir_ / "a.exr"), Error);
  EXPECT_EQ(read_exr_layers(dir_ / "a.exr").scalars.at("Z")[0], 1);
}

TEST_F(Exr, TruncatedAtEveryLengthIsAnErrorOfOneLine) {
  write_exr(dir_ / "whole.exr", random_bits(19, 37, 4));  // three blocks of scan lines
  const auto whole = read_bytes(dir_ / "whole.exr");
  for (size_t length = 0; length < whole.size(); length += length < 600 ? 1 : 37) {
    write(dir_ / "cut.exr", {whole.begin(), whole.begin() + static_cast<ptrdiff_t>(length)});
    const std::string message = message_of(dir_ / "cut.exr");
    EXPECT_NE(message.find("cut.exr: not a readable EXR file"), std::string::npos)
        << length << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST_F(Exr, DamagedBytesNeverCrash) {
  write_exr(dir_ / "whole.exr", random_bits(19, 37, 4));
  const auto whole = read_bytes(dir_ / "whole.exr");
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    auto bytes = whole;
    // Mostly the header and the offset table, where sizes and types stand.
    for (int k = 0; k < 3; ++k)
      bytes[random() % (i % 4 ? 420 : bytes.size())] = static_cast<uint8_t>(random());
    write(dir_ / "damaged.exr", bytes);
    refused += message_of(dir_ / "damaged.exr") != "no error";
  }
  EXPECT_GT(refused, 100);
}

TEST_F(Exr, OtherFilesAreRefused) {
  write_text(dir_ / "text.exr", "not an image at all, but long enough to hold a header");
  EXPECT_NE(message_of(dir_ / "text.exr"), "no error");
  EXPECT_NE(message_of(dir_ / "absent.exr").find("cannot be read"), std::string::npos);
  EXPECT_NE(message_of(dir_), "no error");
}
