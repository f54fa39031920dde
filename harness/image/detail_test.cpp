#include "image/detail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"

using namespace vsglbench;

namespace {

// Edges, a slope and ripples on ground 1.
Image picture(uint32_t w, uint32_t h) {
  Image image(w, h);
  for (uint32_t y = 0; y < h; ++y) {
    for (uint32_t x = 0; x < w; ++x) {
      const float u = static_cast<float>(x), v = static_cast<float>(y);
      const float edge = (x / 9 + y / 7) % 2 == 0 ? 1.0f : 0.0f;
      image.at(x, y) = {1 + edge, 1 + 0.02f * u, 1.5f + 0.5f * std::sin(0.4f * u + 0.2f * v)};
    }
  }
  return image;
}

Image blurred(const Image& image, double sigma) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  Image out(image.width, image.height);
  for (int y = 0; y < static_cast<int>(image.height); ++y) {
    for (int x = 0; x < static_cast<int>(image.width); ++x) {
      glm::dvec3 sum(0);
      double weights = 0;
      for (int v = -reach; v <= reach; ++v) {
        for (int u = -reach; u <= reach; ++u) {
          const int to_x = std::clamp(x + u, 0, static_cast<int>(image.width) - 1);
          const int to_y = std::clamp(y + v, 0, static_cast<int>(image.height) - 1);
          const double weight = std::exp(-0.5 * (u * u + v * v) / (sigma * sigma));
          sum += weight * glm::dvec3(image.at(to_x, to_y));
          weights += weight;
        }
      }
      out.at(x, y) = glm::vec3(sum / weights);
    }
  }
  return out;
}

Image noisy(const Image& image, double sigma, uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, static_cast<float>(sigma));
  Image out = image;
  for (auto& p : out.pixels) p += glm::vec3(noise(random), noise(random), noise(random));
  return out;
}

Detail measure(const Image& x, const Image& half0, const Image& half1, const Mask& mask = {}) {
  DetailMeter meter;
  meter.add(x, half0, half1, mask);
  return meter.finish().value();
}
Detail measure(const Image& x, const Image& r) { return measure(x, r, r); }

// Calls visit(i, j) for each pair of neighbours.
template <class F>
void neighbours(const Image& image, F&& visit) {
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const size_t i = size_t(y) * image.width + x;
      if (x + 1 < image.width) visit(i, i + 1);
      if (y + 1 < image.height) visit(i, i + image.width);
    }
  }
}

// The standard deviation of the slope when x has independent noise of σ in each channel: noise enters
// Σ ∇x·∇r with what the gradients of r at that pixel add up to.
double slope_error(const Image& r, double sigma) {
  std::vector<glm::dvec3> weight(r.pixels.size());
  double energy = 0;
  neighbours(r, [&](size_t i, size_t j) {
    const glm::dvec3 d = glm::dvec3(r.pixels[j]) - glm::dvec3(r.pixels[i]);
    weight[j] += d, weight[i] -= d;
    energy += glm::dot(d, d);
  });
  double square = 0;
  for (const auto& w : weight) square += glm::dot(w, w);
  return sigma * std::sqrt(square) / energy;
}

}  // namespace

TEST(Detail, ByHand) {
  // Gradients: x across 2 and 4, down 1 and 3; r across 1 and 3, down 2 and 4; in each of three channels.
  Image x(2, 2), r(2, 2);
  const float tx[4] = {1, 3, 2, 6}, tr[4] = {1, 2, 3, 6};
  for (int i = 0; i < 4; ++i) x.pixels[i] = glm::vec3(tx[i]), r.pixels[i] = glm::vec3(tr[i]);
  const Detail d = measure(x, r);
  EXPECT_DOUBLE_EQ(d.slope, (2 * 1 + 4 * 3 + 1 * 2 + 3 * 4) / (1.0 + 9 + 4 + 16));
  EXPECT_DOUBLE_EQ(d.gain, 12.0 / 12);
  EXPECT_DOUBLE_EQ(d.value, 28.0 / 30);
}

TEST(Detail, OfTheReferenceIsOne) {
  const Image r = picture(61, 37);
  EXPECT_DOUBLE_EQ(measure(r, r).value, 1);
  EXPECT_DOUBLE_EQ(measure(r, r).slope, 1);
}

TEST(Detail, FallsWithBlur) {
  const Image r = picture(61, 37);
  double before = 1;
  for (const double sigma : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    const double value = measure(blurred(r, sigma), r).value;
    EXPECT_LT(value, 0.97 * before) << sigma;
    EXPECT_GT(value, 0) << sigma;
    before = value;
  }
  EXPECT_LT(before, 0.3);
}

// Where a ratio of energies would rise to several times one.
TEST(Detail, NoiseScattersItButDoesNotRaiseIt) {
  const Image r = picture(61, 37);
  const double sigma = 0.5;
  for (uint32_t seed = 0; seed < 8; ++seed) {
    const Image x = noisy(r, sigma, seed);
    double energy_x = 0, energy_r = 0;
    neighbours(r, [&](size_t i, size_t j) {
      const glm::vec3 dx = x.pixels[j] - x.pixels[i], dr = r.pixels[j] - r.pixels[i];
      energy_x += glm::dot(dx, dx), energy_r += glm::dot(dr, dr);
    });
    EXPECT_GT(energy_x / energy_r, 2);
    EXPECT_NEAR(measure(x, r).slope, 1, 3.5 * slope_error(r, sigma)) << seed;
  }
  EXPECT_LT(slope_error(r, sigma), 0.04) << "the bound tells something";
}

TEST(Detail, GainIsFoldedOut) {
  const Image r = picture(61, 37), soft = blurred(r, 1);
  Image x = soft;
  for (auto& p : x.pixels) p *= 0.25f;
  EXPECT_DOUBLE_EQ(measure(x, r).slope, 0.25 * measure(soft, r).slope);
  EXPECT_DOUBLE_EQ(measure(x, r).gain, 0.25 * measure(soft, r).gain);
  EXPECT_DOUBLE_EQ(measure(x, r).value, measure(soft, r).value);
}

// The truth against a noisy reference: with its halves 1, with their mean in place of both lower by the
// noise's share of the energy.
TEST(Detail, NoiseOfTheReferenceDoesNotLowerIt) {
  const Image truth = picture(121, 77);
  const double sigma = 0.3;
  constexpr uint32_t kRuns = 16;
  DetailMeter halves, mean_alone;
  for (uint32_t run = 0; run < kRuns; ++run) {
    const Image a = noisy(truth, sigma, 2 * run), b = noisy(truth, sigma, 2 * run + 1);
    Image r = a;
    for (size_t i = 0; i < r.pixels.size(); ++i) r.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
    halves.add(truth, a, b);
    mean_alone.add(truth, r, r);
  }
  double energy = 0;
  neighbours(truth, [&](size_t i, size_t j) {
    const glm::dvec3 d = glm::dvec3(truth.pixels[j]) - glm::dvec3(truth.pixels[i]);
    energy += glm::dot(d, d);
  });
  // With noises n and m of the halves, Σ ∇a·∇b has n and m once each beside ∇r, where the numerator has half
  // of that, and Σ ∇n·∇m. Its variance is σ⁴ times the squares in the graph's Laplacian, 4² + 4 of a pixel.
  const double single = slope_error(truth, sigma / std::sqrt(2.0));
  const double both = sigma * sigma * std::sqrt(20.0 * 3 * 121 * 77) / energy;
  const double error = std::sqrt((single * single + both * both) / kRuns);
  EXPECT_NEAR(halves.finish()->slope, 1, 3.5 * error);
  EXPECT_LT(error, 0.01) << "the bound tells something";
  // σ²/2 of noise in the mean: each of two neighbours, each pair, each channel.
  const double noise = sigma * sigma * 3 * (120 * 77 + 121 * 76);
  EXPECT_NEAR(mean_alone.finish()->slope, energy / (energy + noise), 0.01);
  EXPECT_LT(mean_alone.finish()->slope, 0.8);
}

TEST(Detail, OfTheMaskAlone) {
  Image r = picture(20, 10), x = r;
  Mask mask(200, 1);
  for (uint32_t y = 0; y < 10; ++y) {
    for (uint32_t u = 12; u < 20; ++u) mask[y * 20 + u] = 0, x.at(u, y) = glm::vec3(1e6f);
  }
  EXPECT_DOUBLE_EQ(measure(x, r, r, mask).value, 1);
  EXPECT_GT(measure(x, r).gain, 1000);
}

TEST(Detail, SumsRunOverFrames) {
  const Image r = picture(30, 20);
  Image bright = r;
  for (auto& p : bright.pixels) p *= 3.0f;
  DetailMeter meter;
  meter.add(r, r, r);
  meter.add(r, bright, bright);
  // Gradients of energy E and 9E; slope (E + 3E) / 10E, gain 2 / 4.
  EXPECT_NEAR(meter.finish()->slope, 0.4, 1e-6);
  EXPECT_NEAR(meter.finish()->value, 0.8, 1e-6);
}

TEST(Detail, NoValueWhereThereIsNoneToTell) {
  const Image flat(5, 5, glm::vec3(2)), r = picture(5, 5);
  const auto value = [](const Image& x, const Image& a, const Image& b) {
    DetailMeter meter;
    meter.add(x, a, b);
    return meter.finish();
  };
  EXPECT_FALSE(value(r, flat, flat)) << "a flat reference";
  EXPECT_FALSE(value(Image(1, 1, glm::vec3(1)), Image(1, 1, glm::vec3(1)), Image(1, 1, glm::vec3(1))));
  EXPECT_FALSE(value(Image(5, 5), r, r)) << "a black image has no gain";
  EXPECT_FALSE(DetailMeter().finish());
  Image against = r;
  for (auto& p : against.pixels) p = glm::vec3(5) - p;
  EXPECT_FALSE(value(r, r, against)) << "halves that have no gradient in common";
  EXPECT_EQ(value(flat, r, r)->value, 0.0) << "nothing of the reference's detail";
}

TEST(Detail, RefusesWhatMetricsRefuse) {
  const Image r = picture(4, 3);
  Image bad = r;
  bad.at(1, 1).x = std::numeric_limits<float>::infinity();
  DetailMeter meter;
  EXPECT_THROW(meter.add(bad, r, r), Error);
  EXPECT_THROW(meter.add(r, bad, r), Error);
  EXPECT_THROW(meter.add(r, r, bad), Error);
  EXPECT_THROW(meter.add(picture(3, 4), r, r), Error);
  EXPECT_THROW(meter.add(r, r, picture(3, 4)), Error);
  EXPECT_THROW(meter.add(r, r, r, Mask(3, 1)), Error);
  EXPECT_FALSE(meter.finish());
  EXPECT_EQ(detail_formula().id, "gradient-slope-over-gain");
}
