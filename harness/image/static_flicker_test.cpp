#include "image/static_flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"

using namespace vsglbench;

namespace {

Image random_image(uint32_t w, uint32_t h, std::mt19937* random) {
  std::uniform_real_distribution<float> value(0, 4);
  Image image(w, h);
  for (auto& p : image.pixels) p = {value(*random), value(*random), value(*random)};
  return image;
}

double channel(const Image& image, size_t i, int c) { return image.pixels[i][c]; }

// p-quantile of all values, sorted: between the two that stand beside p (n − 1).
double sorted_quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const size_t k = static_cast<size_t>(at);
  if (k + 1 == values.size()) return values[k];
  return values[k] * (1 - (at - k)) + values[k + 1] * (at - k);
}

}  // namespace

TEST(StaticFlicker, IsTheDefinitionOverAllSeeds) {
  const std::tuple<uint32_t, uint32_t, size_t> sizes[] = {{1, 1, 2}, {7, 3, 8}, {19, 11, 5}};
  for (const auto& [w, h, seeds] : sizes) {
    std::mt19937 random(w);
    const Image r = random_image(w, h, &random);
    Mask mask(r.pixels.size());
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = i == 0 || random() % 4 != 0;
    std::vector<Image> images;
    for (size_t s = 0; s < seeds; ++s) images.push_back(random_image(w, h, &random));
    StaticFlickerMeter meter(r, mask);
    for (const Image& x : images) meter.add(x);
    double mean_r = 0, n = 0, total = 0;
    std::vector<double> of_pixels, off(seeds);
    for (size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] == 0) continue;
      double of_pixel = 0;
      for (int c = 0; c < 3; ++c) {
        mean_r += channel(r, i, c), ++n;
        double mean = 0, square = 0;
        for (const Image& x : images) mean += channel(x, i, c) / static_cast<double>(seeds);
        for (size_t s = 0; s < seeds; ++s) {
          const double d = channel(images[s], i, c) - mean;
          square += d * d;
          off[s] += std::abs(d);
        }
        of_pixel += std::sqrt(square / static_cast<double>(seeds - 1)) / 3;
      }
      of_pixels.push_back(of_pixel);
      total += 3 * of_pixel;
    }
    mean_r /= n;
    const StaticFlicker f = meter.finish().value();
    EXPECT_NEAR(f.value, total / n / mean_r, 1e-12);
    EXPECT_NEAR(f.p99, sorted_quantile(of_pixels, 0.99) / mean_r, 1e-12);
    EXPECT_NEAR(f.worst, *std::ranges::max_element(of_pixels) / mean_r, 1e-12);
    EXPECT_NEAR(f.mean_reference, mean_r, 1e-12);
    for (size_t s = 0; s < seeds; ++s)
      EXPECT_NEAR(meter.deviation(images[s]).value(), off[s] / n / mean_r, 1e-12);
  }
}

TEST(StaticFlicker, ByHand) {
  const Image r(2, 1, glm::vec3(2));
  StaticFlickerMeter meter(r);
  for (const float v : {1.0f, 2.0f, 6.0f}) {
    Image x(2, 1, glm::vec3(5));
    x.pixels[1] = glm::vec3(v);
    meter.add(x);
  }
  // Deviations from the mean 3: −2, −1, 3; variance 14 / 2.
  const StaticFlicker f = meter.finish().value();
  EXPECT_DOUBLE_EQ(f.value, std::sqrt(7.0) / 2 / 2);
  EXPECT_DOUBLE_EQ(f.worst, std::sqrt(7.0) / 2);
  EXPECT_EQ(f.worst_pixel, glm::uvec2(1, 0));
  Image last(2, 1, glm::vec3(5));
  last.pixels[1] = glm::vec3(6);
  EXPECT_DOUBLE_EQ(meter.deviation(last).value(), 3 / 2.0 / 2);
}

TEST(StaticFlicker, SeedsThatAreAlikeHaveNoneToTheBit) {
  std::mt19937 random(6);
  const Image x = random_image(13, 9, &random);
  StaticFlickerMeter meter(x);
  for (int s = 0; s < 8; ++s) meter.add(x);
  EXPECT_EQ(meter.finish()->value, 0.0);
  EXPECT_EQ(meter.finish()->p99, 0.0);
  EXPECT_EQ(meter.deviation(x), 0.0);
}

// The root of the unbiased variance of eight Gaussian samples is 0.9650 of σ in the mean.
TEST(StaticFlicker, OfNoiseIsItsDeviation) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(100, 10);
  StaticFlickerMeter meter(Image(64, 64, glm::vec3(50)));
  for (int s = 0; s < 8; ++s) {
    Image x(64, 64);
    for (auto& p : x.pixels) p = {noise(random), noise(random), noise(random)};
    meter.add(x);
  }
  // The standard error of the mean over 12288 channels is 0.262 · 0.2 / √12288 = 0.0005.
  EXPECT_NEAR(meter.finish()->value, 0.2 * 0.9650, 4 * 0.0005);
}

TEST(StaticFlicker, RefusesWhatItCannotTell) {
  const Image r(3, 2, glm::vec3(1));
  StaticFlickerMeter meter(r);
  EXPECT_THROW(meter.finish(), Error);
  meter.add(r);
  EXPECT_THROW(meter.finish(), Error) << "one seed";
  EXPECT_THROW(meter.deviation(r), Error);
  EXPECT_THROW(meter.add(Image(2, 3)), Error);
  Image bad = r;
  bad.at(2, 1).z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(meter.add(bad), Error);
  EXPECT_THROW(StaticFlickerMeter{bad}, Error);
  EXPECT_THROW(StaticFlickerMeter(r, Mask(6, 0)), Error);
  EXPECT_THROW(StaticFlickerMeter(Image{}), Error);
  meter.add(Image(3, 2, glm::vec3(3)));
  EXPECT_DOUBLE_EQ(meter.finish()->value, std::sqrt(2.0));
  StaticFlickerMeter black(Image(3, 2));
  black.add(r);
  black.add(r);
  EXPECT_FALSE(black.finish());
  EXPECT_FALSE(black.deviation(r));
}

TEST(StaticFlicker, TheFormulaIsNamed) {
  EXPECT_EQ(static_flicker_formula().id, "flicker-static-mean-reference");
}
