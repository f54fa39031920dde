#include "image/spikes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "base/error.h"

using namespace vsglbench;

namespace {

double luminance64(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

Image noisy(uint32_t w, uint32_t h, uint64_t seed, float spread) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> normal(0, spread);
  Image image(w, h);
  for (glm::vec3& p : image.pixels)
    p = {std::exp(normal(random)), std::exp(normal(random)), std::exp(normal(random))};
  return image;
}

// From the definition: every pixel against every other.
double counted(const Image& x, const Image& r, const Mask& mask) {
  double pixels = 0, mean = 0, spikes = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) continue;
    pixels += 1;
    mean += luminance64(r.pixels[i]);
  }
  mean /= pixels;
  const auto column = [&](size_t i) { return static_cast<int>(i % r.width); };
  const auto row = [&](size_t i) { return static_cast<int>(i / r.width); };
  for (size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) continue;
    double nearby = 0;
    for (size_t j = 0; j < mask.size(); ++j) {
      if (std::abs(column(i) - column(j)) <= 1 && std::abs(row(i) - row(j)) <= 1)
        nearby = std::max(nearby, luminance64(r.pixels[j]));
    }
    const double y = luminance64(x.pixels[i]);
    spikes += y > 4 * nearby && y > 2 * mean;
  }
  return spikes / pixels;
}

}  // namespace

TEST(Spikes, AreCountedAsDefined) {
  size_t some = 0;
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const Image r = noisy(17, 11, seed, 0.5f), x = noisy(17, 11, seed + 100, 2);
    Mask mask(17 * 11);
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = (i * 7 + seed) % 5 != 0;
    const auto share = spike_share(x, r, mask);
    ASSERT_TRUE(share);
    EXPECT_DOUBLE_EQ(*share, counted(x, r, mask)) << seed;
    some += *share > 0 && *share < 1;
  }
  EXPECT_EQ(some, 8u);
}

// In the middle, at an edge and in corners; beside an edge of the reference, its brighter side counts.
TEST(Spikes, PlantedOnesAreFound) {
  Image r(40, 30, glm::vec3(1));
  for (uint32_t y = 0; y < 30; ++y) {
    for (uint32_t x = 20; x < 40; ++x) r.at(x, y) = glm::vec3(0.1f);
  }
  EXPECT_EQ(spike_share(r, r), 0);
  Image x = r;
  const std::pair<int, int> planted[] = {{5, 5}, {0, 0}, {0, 29}, {7, 0}, {39, 29}};
  for (const auto& [u, v] : planted) x.at(u, v) = glm::vec3(5);
  x.at(20, 9) = glm::vec3(3);     // 30 times what is there, 3 times what is beside it
  x.at(30, 9) = glm::vec3(0.9f);  // 9 times what is there, but below twice the mean of 0.55
  x.at(12, 9) = glm::vec3(4);     // not above four times
  EXPECT_DOUBLE_EQ(spike_share(x, r).value(), 5.0 / 1200);
  x.at(20, 9) = glm::vec3(4.5f);
  x.at(30, 9) = glm::vec3(1.2f);
  EXPECT_DOUBLE_EQ(spike_share(x, r).value(), 7.0 / 1200);
}

TEST(Spikes, WhatIsTooBrightAsAWholeIsNone) {
  const Image r = noisy(64, 48, 1, 0.7f);
  Image thrice = r;
  for (glm::vec3& p : thrice.pixels) p *= 3.0f;
  EXPECT_EQ(spike_share(thrice, r), 0);
  // Light that lies a pixel off is none either.
  Image moved(64, 48);
  for (uint32_t v = 0; v < 48; ++v) {
    for (uint32_t u = 0; u < 64; ++u) moved.at(u, v) = r.at(std::min(u + 1, 63u), v > 0 ? v - 1 : 0);
  }
  EXPECT_EQ(spike_share(moved, r), 0);
}

TEST(Spikes, PixelsOutsideTheMaskAreNotCounted) {
  const Image r(10, 10, glm::vec3(1));
  Image x = r;
  x.at(3, 3) = x.at(8, 8) = glm::vec3(100);
  Mask mask(100, 1);
  mask[33] = 0;
  EXPECT_DOUBLE_EQ(spike_share(x, r, mask).value(), 1.0 / 99);
}

TEST(Spikes, NothingIsSaidBesideABlackReferenceOrOfImagesThatCannotBeCompared) {
  const Image black(4, 4), white(4, 4, glm::vec3(1));
  EXPECT_FALSE(spike_share(white, black));
  EXPECT_THROW(spike_share(white, white, Mask(16)), Error);
  EXPECT_THROW(spike_share(white, Image(4, 5, glm::vec3(1))), Error);
  Image bad = white;
  bad.at(1, 1).x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(spike_share(bad, white), Error);
}
