#include "image/png16.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/file.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

class Png16 : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_png16_test_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }
};

struct Codes {
  uint32_t width = 0, height = 0;
  int bits = 0, color = 0;
  bool srgb = false;
  std::string comment;
  std::vector<uint16_t> values;
};

// What libpng has to say of a file.
Codes read(const fs::path& path) {
  Codes out;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png))) {
    ADD_FAILURE() << path << " is damaged";
    std::fclose(file);
    return out;
  }
  png_init_io(png, file);
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  out.width = png_get_image_width(png, info);
  out.height = png_get_image_height(png, info);
  out.bits = png_get_bit_depth(png, info);
  out.color = png_get_color_type(png, info);
  out.srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
  png_textp text = nullptr;
  if (png_get_text(png, info, &text, nullptr) > 0) out.comment = text[0].text;
  png_bytepp rows = png_get_rows(png, info);
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t i = 0; i < 3 * out.width; ++i)
      out.values.push_back(static_cast<uint16_t>(rows[y][2 * i] << 8 | rows[y][2 * i + 1]));
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return out;
}

// The inverse of sRGB's OETF (IEC 61966-2-1).
double decode_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}  // namespace

TEST_F(Png16, ReadsBackWithinHalfACode) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-14, 3);
  for (const auto& [w, h] : {std::pair{1u, 1u}, {7u, 3u}, {480u, 32u}}) {
    for (const float peak : {1.0f, 12.34f, 0.0007f}) {
      Image image(w, h);
      for (auto& p : image.pixels) {
        for (int c = 0; c < 3; ++c) p[c] = peak * std::exp2(exponent(random));
      }
      write_png16(dir_ / "a.png", image, peak);
      const Codes codes = read(dir_ / "a.png");
      ASSERT_EQ(codes.width, w);
      ASSERT_EQ(codes.height, h);
      EXPECT_EQ(codes.bits, 16);
      EXPECT_EQ(codes.color, PNG_COLOR_TYPE_RGB);
      EXPECT_TRUE(codes.srgb);
      for (size_t i = 0; i < codes.values.size(); ++i) {
        // Half a code to either side of what was stored; white goes on for ever.
        const double code = codes.values[i], linear = double(image.pixels[i / 3][i % 3]) / peak;
        EXPECT_GE(linear, decode_srgb((code - 0.5 - 1e-6) / 65535)) << code;
        EXPECT_TRUE(code == 65535 || linear <= decode_srgb((code + 0.5 + 1e-6) / 65535)) << code;
      }
    }
  }
}

TEST_F(Png16, CodesByHand) {
  EXPECT_EQ(encode_srgb16(0), 0);
  EXPECT_EQ(encode_srgb16(-3), 0);
  EXPECT_EQ(encode_srgb16(1), 65535);
  EXPECT_EQ(encode_srgb16(9), 65535);
  EXPECT_EQ(encode_srgb16(0.5), 48192);   // 0.7353569831
  EXPECT_EQ(encode_srgb16(0.001), 847);   // linear part: 12.92 · 0.001 · 65535 = 846.7
  EXPECT_EQ(encode_srgb16(0.18), 30235);  // 0.4613561296
}

TEST_F(Png16, SaysItsPeakAndWhatItLost) {
  Image image(4, 1, glm::vec3(2));
  image.pixels[0] = {2.5f, 2.6f, 0};
  image.pixels[1] = {2.501f, -1, 0};
  image.pixels[2].z = -0.5f;
  const Png16Loss loss = write_png16(dir_ / "a.png", image, 2.5f);
  EXPECT_EQ(loss.above, 2u);
  EXPECT_EQ(loss.below, 2u);
  EXPECT_EQ(read(dir_ / "a.png").comment, "sRGB; linear 1 (code 65535) is 2.5 W/m2/sr");
  EXPECT_EQ(write_png16(dir_ / "a.png", Image(2, 2, glm::vec3(3)), 3).above, 0u);
}

TEST_F(Png16, RefusesWhatItCannotStore) {
  const Image image(2, 2, glm::vec3(1));
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float peak : {0.0f, -1.0f, inf, nan})
    EXPECT_THROW(write_png16(dir_ / "a.png", image, peak), Error) << peak;
  EXPECT_THROW(write_png16(dir_ / "a.png", Image(), 1), Error);
  for (const float bad : {inf, nan}) {
    Image broken = image;
    broken.at(1, 0).y = bad;
    EXPECT_THROW(write_png16(dir_ / "a.png", broken, 1), Error);
  }
  EXPECT_TRUE(fs::is_empty(dir_));
}

TEST_F(Png16, TheCommandLineIsQuoted) {
  EXPECT_EQ(frame_file_name(7), "0007.png");
  EXPECT_EQ(frame_file_name(12345), "12345.png");
  EXPECT_EQ(cvvdp_command("out/test", "it's/r", 24),
            "cvvdp --test 'out/test/%04d.png' --ref 'it'\\''s/r/%04d.png' --fps 24 --display standard_fhd");
  EXPECT_TRUE(cvvdp_command("a", "b", 24, "x; rm $(y)").ends_with(" --display 'x; rm $(y)'"));
  EXPECT_TRUE(cvvdp_command("a", "b", 24, "").ends_with(" --display ''"));
}
