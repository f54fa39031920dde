#include "image/error_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "image/theme.h"

using namespace vsglbench;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class ErrorColors : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { set_theme(GetParam()); }
  void TearDown() override { set_theme("dark"); }
};

float lightness(float t) { return luminance(glm::vec3(diverging_color(t))); }

}  // namespace

TEST(ErrorMap, SignsAndLimits) {
  Image x(5, 1), r(5, 1);
  x.pixels = {glm::vec3(3), glm::vec3(1), glm::vec3(0), glm::vec3(2), glm::vec3(kNaN)};
  r.pixels = {glm::vec3(1), glm::vec3(3), glm::vec3(0), glm::vec3(0), glm::vec3(1)};
  const Image e = error_map(x, r);
  EXPECT_NEAR(e.pixels[0].x, 1, 1e-6);
  EXPECT_NEAR(e.pixels[1].x, -1, 1e-6);
  EXPECT_EQ(e.pixels[2].x, 0);
  EXPECT_NEAR(e.pixels[3].x, 2, 1e-6);
  EXPECT_TRUE(std::isnan(e.pixels[4].x));
  EXPECT_EQ(error_map(x, r, {0, 1, 1, 1, 0}).pixels[0].x, 0);
  EXPECT_THROW(error_map(x, Image(4, 1)), Error);
}

TEST(ErrorMap, CountsWhatIsClipped) {
  Image e(4, 1);
  e.pixels = {glm::vec3(1.5f), glm::vec3(-1.01f), glm::vec3(1), glm::vec3(2)};
  EXPECT_EQ(clipped_share(e, 1), 0.75);
  EXPECT_NEAR(clipped_share(e, 1, {1, 1, 1, 0}), 2.0 / 3, 1e-12);
  EXPECT_EQ(clipped_share(e, 1, {0, 0, 0, 0}), 0);
}

// From the paper's lightness at 0 to the other end at either side, without a turn.
TEST_P(ErrorColors, DivergeFromThePaper) {
  const float turn = GetParam() == "dark" ? 1 : -1;
  for (int k = 1; k <= 100; ++k) {
    EXPECT_GT(turn * lightness(0.01f * k), turn * lightness(0.01f * (k - 1)) - 0.5f) << k;
    EXPECT_GT(turn * lightness(-0.01f * k), turn * lightness(-0.01f * (k - 1)) - 0.5f) << k;
  }
  EXPECT_LT(std::abs(lightness(0) - luminance(glm::vec3(theme().paper))), 15);
  EXPECT_GT(diverging_color(0.4f).x, diverging_color(0.4f).z);    // too bright: red
  EXPECT_GT(diverging_color(-0.4f).z, diverging_color(-0.4f).x);  // too dark: blue
  EXPECT_EQ(diverging_color(1), diverging_color(7));
}

TEST_P(ErrorColors, TellNoSurfaceAndNoNumber) {
  Image e(3, 1);
  e.pixels[1] = glm::vec3(kNaN);
  const Bitmap b = color_error_map(e, 1, {1, 1, 0});
  EXPECT_EQ(b.at(0, 0)[0], diverging_color(0).x);
  EXPECT_EQ(b.at(1, 0)[0], 255);
  EXPECT_EQ(b.at(1, 0)[1], 0);
  EXPECT_NE(b.at(2, 0)[0], b.at(0, 0)[0]);
}

INSTANTIATE_TEST_SUITE_P(Theme, ErrorColors, ::testing::ValuesIn(theme_names()),
                         [](const auto& theme) { return theme.param; });

TEST(Theme, RefusesOneThatIsNone) { EXPECT_THROW(set_theme("sepia"), std::invalid_argument); }
