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

namespace {

struct Definition {
  double value = 0, p99 = 0, mean_reference = 0;
  std::vector<double> away;
};

// Every pair of seeds by itself.
Definition by_pairs(const std::vector<Image>& images, const Image& r, const Mask& mask) {
  const size_t seeds = images.size();
  Definition out;
  out.away.resize(seeds);
  std::vector<double> pixels;
  double channels = 0, total = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    double pixel = 0;
    for (int c = 0; c < 3; ++c) {
      out.mean_reference += channel(r, i, c), ++channels;
      for (size_t s = 0; s < seeds; ++s) {
        for (size_t t = s + 1; t < seeds; ++t) {
          const double d = std::abs(channel(images[s], i, c) - channel(images[t], i, c));
          out.away[s] += d, out.away[t] += d;
          pixel += d, total += d;
        }
      }
    }
    pixels.push_back(pixel);
  }
  out.mean_reference /= channels;
  const double pairs = static_cast<double>(seeds * (seeds - 1)) / 2;
  out.value = total / pairs / channels / out.mean_reference;
  out.p99 = sorted_quantile(pixels, 0.99) / 3 / pairs / out.mean_reference;
  for (double& d : out.away) d /= static_cast<double>(seeds - 1) * channels * out.mean_reference;
  return out;
}

std::vector<Image> noisy(size_t seeds, uint32_t size, std::mt19937* random) {
  std::normal_distribution<float> noise(100, 10);
  std::vector<Image> images;
  for (size_t s = 0; s < seeds; ++s) {
    Image x(size, size);
    for (auto& p : x.pixels) p = {noise(*random), noise(*random), noise(*random)};
    images.push_back(std::move(x));
  }
  return images;
}

}  // namespace

TEST(StaticFlicker, IsTheDefinitionOverAllPairs) {
  const std::tuple<uint32_t, uint32_t, size_t> sizes[] = {{1, 1, 2}, {7, 3, 8}, {19, 11, 5}};
  for (const auto& [w, h, seeds] : sizes) {
    std::mt19937 random(w);
    const Image r = random_image(w, h, &random);
    Mask mask(r.pixels.size());
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = i == 0 || random() % 4 != 0;
    std::vector<Image> images;
    for (size_t s = 0; s < seeds; ++s) images.push_back(random_image(w, h, &random));
    const StaticFlicker f = static_flicker(images, r, mask).value();
    const Definition expected = by_pairs(images, r, mask);
    EXPECT_NEAR(f.value, expected.value, 1e-12);
    EXPECT_NEAR(f.p99, expected.p99, 1e-12);
    EXPECT_NEAR(f.mean_reference, expected.mean_reference, 1e-12);
    ASSERT_EQ(f.series.size(), seeds);
    for (size_t s = 0; s < seeds; ++s) EXPECT_NEAR(f.series[s], expected.away[s], 1e-12);
  }
}

TEST(StaticFlicker, ByHand) {
  std::vector<Image> images;
  for (const float v : {6.0f, 1.0f, 2.0f}) {
    Image x(2, 1, glm::vec3(5));
    x.pixels[1] = glm::vec3(v);
    images.push_back(x);
  }
  // Of the second pixel: 5, 4 and 1 apart; over two pixels and a reference of 2.
  const StaticFlicker f = static_flicker(images, Image(2, 1, glm::vec3(2))).value();
  EXPECT_DOUBLE_EQ(f.value, 10.0 / 3 / 2 / 2);
  EXPECT_DOUBLE_EQ(f.series[0], 4.5 / 2 / 2);
  EXPECT_DOUBLE_EQ(f.series[1], 3.0 / 2 / 2);
}

TEST(StaticFlicker, SeedsThatAreAlikeHaveNoneToTheBit) {
  std::mt19937 random(6);
  const Image x = random_image(13, 9, &random);
  const StaticFlicker f = static_flicker(std::vector<Image>(8, x), x).value();
  EXPECT_EQ(f.value, 0.0);
  EXPECT_EQ(f.p99, 0.0);
  EXPECT_EQ(f.series, std::vector<double>(8, 0.0));
}

// What it is of few seeds, it is of many: 2/√π of the deviation of Gaussian noise.
TEST(StaticFlicker, OfNoiseIsTheSameForAnyNumberOfSeeds) {
  std::mt19937 random(7);
  for (const size_t seeds : {2u, 3u, 8u}) {
    const double value = static_flicker(noisy(seeds, 64, &random), Image(64, 64, glm::vec3(50)))->value;
    // One pair's distance has a deviation of 0.853 σ; 12288 channels.
    EXPECT_NEAR(value, 0.2 * 1.1284, 4 * 0.2 * 0.853 / std::sqrt(12288)) << seeds << " seeds";
  }
}

// One pixel in a thousand has a spike in any one seed: a standard deviation of 4 seeds would see half of it.
TEST(StaticFlicker, OfRareSpikesIsTheSameForAnyNumberOfSeeds) {
  std::mt19937 random(8);
  std::bernoulli_distribution spike(0.001);
  for (const size_t seeds : {2u, 4u, 16u}) {
    std::vector<Image> images(seeds, Image(256, 256, glm::vec3(1)));
    double spikes = 0;
    for (Image& x : images)
      for (auto& p : x.pixels)
        if (spike(random)) p = glm::vec3(101), ++spikes;
    const double share = spikes / static_cast<double>(seeds) / 65536;
    EXPECT_NEAR(static_flicker(images, Image(256, 256, glm::vec3(1)))->value, 100 * 2 * share * (1 - share),
                0.02 * 100 * 2 * share)
        << seeds << " seeds";
  }
}

// Leaving one seed out after the other.
TEST(StaticFlicker, PseudovaluesAreTheJackknifes) {
  std::mt19937 random(9);
  const std::vector<Image> images = noisy(6, 5, &random);
  const Image r(5, 5, glm::vec3(50));
  const StaticFlicker all = static_flicker(images, r).value();
  ASSERT_EQ(all.pseudovalues.size(), 6u);
  for (size_t s = 0; s < images.size(); ++s) {
    std::vector<Image> others = images;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(s));
    EXPECT_NEAR(all.pseudovalues[s], 6 * all.value - 5 * static_flicker(others, r)->value, 1e-12);
  }
  EXPECT_TRUE(static_flicker(std::span(images).first(2), r)->pseudovalues.empty());
}

TEST(StaticFlicker, RefusesWhatItCannotTell) {
  const Image r(3, 2, glm::vec3(1));
  EXPECT_THROW(static_flicker({}, r), Error);
  EXPECT_THROW(static_flicker(std::vector<Image>{r}, r), Error) << "one seed";
  EXPECT_THROW(static_flicker(std::vector<Image>{r, Image(2, 3)}, r), Error);
  Image bad = r;
  bad.at(2, 1).z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(static_flicker(std::vector<Image>{r, bad}, r), Error);
  EXPECT_THROW(static_flicker(std::vector<Image>{r, r}, bad), Error);
  EXPECT_THROW(static_flicker(std::vector<Image>{r, r}, r, Mask(6, 0)), Error);
  EXPECT_THROW(static_flicker(std::vector<Image>{{}, {}}, Image{}), Error);
  EXPECT_DOUBLE_EQ(static_flicker(std::vector<Image>{r, Image(3, 2, glm::vec3(3))}, r)->value, 2);
  EXPECT_FALSE(static_flicker(std::vector<Image>{r, r}, Image(3, 2))) << "black";
}

TEST(StaticFlicker, TheFormulaIsNamed) {
  EXPECT_EQ(static_flicker_formula().id, "flicker-static-pairs-mean-reference");
}
