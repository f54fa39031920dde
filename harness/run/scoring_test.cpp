#include "run/scoring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace vsglbench {
namespace {

constexpr uint32_t kWidth = 12, kHeight = 9;
constexpr Crop kRegion{2, 3, 7, 4};

// A picture with detail, and its noise.
struct Made {
  ReferenceResult reference;
  Image x{kWidth, kHeight};
  Mask mask = Mask(kWidth * kHeight, 1);

  Made() {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<float> value(0.2f, 2), noise(-0.1f, 0.1f);
    reference.mean = reference.half[0] = reference.half[1] = Image(kWidth, kHeight);
    for (size_t i = 0; i < mask.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const float r = value(random), n = noise(random);
        reference.half[0].pixels[i][c] = r + n;
        reference.half[1].pixels[i][c] = r - n;
        reference.mean.pixels[i][c] = r;
        x.pixels[i][c] = 0.4f * r + 0.6f * value(random);
      }
      mask[i] = i % 7 != 0;
    }
    x.pixels[3 * kWidth + 4] = glm::vec3(50);  // a spike in the region
  }

  std::vector<SeedScore> score(const std::optional<Crop>& region) const {
    Scoring scoring(reference, mask, region);
    scoring.add(1, reference.mean);
    scoring.add(0, x);
    return scoring.collect();
  }
};

using Inside = std::function<bool(uint32_t x, uint32_t y)>;

// Slope over gain, over all pairs of neighbours of which both are inside.
double detail_by_definition(const Made& m, const Inside& inside) {
  double test = 0, own = 0, sum_x = 0, sum_r = 0;
  const auto value = [](const Image& image, uint32_t x, uint32_t y, int c) {
    return double(image.at(x, y)[c]);
  };
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (!inside(x, y)) continue;
      for (int c = 0; c < 3; ++c) {
        const auto& [a, b] = m.reference.half;
        sum_x += value(m.x, x, y, c);
        sum_r += (value(a, x, y, c) + value(b, x, y, c)) / 2;
        for (const auto& [u, v] : {std::pair(x + 1, y), std::pair(x, y + 1)}) {
          if (u >= kWidth || v >= kHeight || !inside(u, v)) continue;
          const double da = value(a, u, v, c) - value(a, x, y, c), db = value(b, u, v, c) - value(b, x, y, c);
          test += (value(m.x, u, v, c) - value(m.x, x, y, c)) * (da + db) / 2;
          own += da * db;
        }
      }
    }
  }
  return (test / own) / (sum_x / sum_r);
}

bool in_region(uint32_t x, uint32_t y) {
  return x >= kRegion.x && x < kRegion.x + kRegion.width && y >= kRegion.y && y < kRegion.y + kRegion.height;
}

TEST(Scoring, ErrorsInTheRegionAreOverItsPixelsAlone) {
  const Made m;
  const std::vector<SeedScore> scores = m.score(kRegion);
  ASSERT_EQ(scores.size(), 2u);
  double count = 0, square = 0, symmetric = 0, sum_x = 0, sum_r = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (!in_region(x, y) || !m.mask[y * kWidth + x]) continue;
      for (int c = 0; c < 3; ++c) {
        const double a = m.x.at(x, y)[c], r = m.reference.mean.at(x, y)[c];
        count += 1;
        square += (a - r) * (a - r);
        symmetric += std::abs(a - r) / ((a + r) / 2);
        sum_x += a;
        sum_r += r;
      }
    }
  }
  const RegionErrors& region = scores[0].region.value();
  EXPECT_NEAR(region.rmse, std::sqrt(square / count), 1e-9);
  EXPECT_NEAR(region.smape, 100 * symmetric / count, 1e-9);
  EXPECT_NEAR(region.bias.value(), (sum_x - sum_r) / sum_r, 1e-9);
  EXPECT_GT(std::abs(region.rmse - scores[0].errors.rmse), 0.01);
  EXPECT_EQ(scores[1].region->rmse, 0);  // the reference itself
  EXPECT_EQ(scores[1].region->bias, 0);
}

TEST(Scoring, DetailIsToldOfTheWholePictureAndOfTheRegion) {
  const Made m;
  const SeedScore score = m.score(kRegion).at(0);
  const Inside kept = [&](uint32_t x, uint32_t y) { return m.mask[y * kWidth + x] != 0; };
  const Inside both = [&](uint32_t x, uint32_t y) { return kept(x, y) && in_region(x, y); };
  EXPECT_NEAR(score.detail.value(), detail_by_definition(m, kept), 1e-9);
  EXPECT_NEAR(score.region.value().detail.value(), detail_by_definition(m, both), 1e-9);
  EXPECT_GT(std::abs(*score.detail - *score.region->detail), 1e-3);
}

TEST(Scoring, WithoutHalvesOfTheReferenceThereIsNoDetail) {
  Made m;
  for (Image& half : m.reference.half) half = Image();
  const SeedScore score = m.score(kRegion).at(0);
  EXPECT_FALSE(score.detail);
  EXPECT_FALSE(score.region.value().detail);
  EXPECT_GT(score.region->rmse, 0);
}

TEST(Scoring, TheSpikeIsCounted) {
  const Made m;
  double pixels = 0;
  for (const uint8_t kept : m.mask) pixels += kept;
  const auto scores = m.score(std::nullopt);
  EXPECT_DOUBLE_EQ(scores[0].spikes.value(), 1 / pixels);
  EXPECT_EQ(scores[1].spikes, 0);
  EXPECT_FALSE(scores[0].region);
}

TEST(Scoring, ARegionOfWhichNoPixelCountsIsNone) {
  Made m;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      if (in_region(x, y)) m.mask[y * kWidth + x] = 0;
    }
  }
  EXPECT_FALSE(m.score(kRegion).at(0).region);
  EXPECT_FALSE(Scoring(m.reference, m.mask, kRegion).has_region());
  m.mask[5 * kWidth + 5] = 1;
  EXPECT_TRUE(Scoring(m.reference, m.mask, kRegion).has_region());
  EXPECT_FALSE(Scoring(m.reference, m.mask).has_region());
}

// Its own mask, its own reference: never those of another case.
TEST(Scoring, AKeptReferenceOfFlipServesTheSamePixelsAlone) {
  Made m, other;
  m.reference.hash = "a";
  other.reference.hash = "b";
  for (glm::vec3& p : other.reference.mean.pixels) p *= 0.5f;
  Mask fewer = m.mask;
  for (size_t i = 0; i < fewer.size() / 2; ++i) fewer[i] = 0;
  FlipKeeper keeper;
  const auto flip = [&](const Made& made, const Mask& mask, FlipKeeper* kept) {
    Scoring scoring(made.reference, mask, std::nullopt, kept);
    scoring.add(0, made.x);
    return scoring.collect().at(0).errors.flip.value();
  };
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(flip(m, m.mask, &keeper), flip(m, m.mask, nullptr));
    EXPECT_EQ(flip(m, fewer, &keeper), flip(m, fewer, nullptr));
    EXPECT_EQ(flip(other, m.mask, &keeper), flip(other, m.mask, nullptr));
  }
  EXPECT_NE(flip(m, m.mask, nullptr), flip(m, fewer, nullptr));
  EXPECT_NE(flip(m, m.mask, nullptr), flip(other, m.mask, nullptr));
}

}  // namespace
}  // namespace vsglbench
