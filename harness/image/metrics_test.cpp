#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "image/error_map.h"

using namespace vsglbench;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

Image random_image(uint32_t w, uint32_t h, uint32_t seed, float low = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(low, 4);
  Image image(w, h);
  for (auto& p : image.pixels) p = {value(random), value(random), value(random)};
  return image;
}

}  // namespace

TEST(Metrics, ByHand) {
  // Two pixels: x = (1,2,3),(0,0,4); r = (1,1,1),(0,2,4).
  Image x(2, 1), r(2, 1);
  x.pixels = {{1, 2, 3}, {0, 0, 4}};
  r.pixels = {{1, 1, 1}, {0, 2, 4}};
  const Errors e = measure_errors(x, r);
  // |x−r|/((|x|+|r|)/2) = 0, 2/3, 1, 0 (0/0), 2, 0
  EXPECT_NEAR(e.smape, 100 * (2.0 / 3 + 1 + 2) / 6, 1e-12);
  EXPECT_NEAR(e.rmse, std::sqrt(9.0 / 6), 1e-12);  // squares 0, 1, 4, 0, 4, 0
  EXPECT_NEAR(*e.rrmse, std::sqrt(9.0 / 6) / 1.5, 1e-12);
  EXPECT_NEAR(*e.bias, 10.0 / 9 - 1, 1e-12);
  // Luminances of r: 1 and 0.7152·2 + 0.0722·4 = 1.7192; ε = (0.01 · 1.3596)².
  const double epsilon = 0.013596 * 0.013596;
  EXPECT_NEAR(*e.mrse, (1 / (1 + epsilon) + 4 / (1 + epsilon) + 4 / (4 + epsilon)) / 6, 1e-12);
  EXPECT_EQ(e.pixels, 2u);
}

TEST(Metrics, AnImageAgainstItselfHasNoError) {
  const Image r = random_image(17, 5, 1);
  const Errors e = measure_errors(r, r);
  for (const Metric m : kMetrics) {
    if (m == Metric::flip) continue;
    EXPECT_EQ(e.value(m), 0.0) << formula(m).name;
  }
}

TEST(Metrics, SmapeIsSymmetricAndEndsAtTwoHundred) {
  const Image a = random_image(13, 7, 1), b = random_image(13, 7, 2);
  EXPECT_DOUBLE_EQ(measure_errors(a, b).smape, measure_errors(b, a).smape);
  EXPECT_GT(measure_errors(a, b).smape, 0);
  EXPECT_LT(measure_errors(a, b).smape, 200);
  EXPECT_DOUBLE_EQ(measure_errors(Image(4, 4), Image(4, 4, glm::vec3(3))).smape, 200);
  EXPECT_DOUBLE_EQ(measure_errors(Image(4, 4, glm::vec3(-1)), Image(4, 4, glm::vec3(1))).smape, 200);
}

TEST(Metrics, ScaledImages) {
  // x = 1.5 r: smape 100 · 0.5/1.25 = 40, bias +0.5; x = 0.5 r: bias −0.5.
  const Image r = random_image(9, 9, 5, 0.5f);
  Image x = r;
  for (auto& p : x.pixels) p *= 1.5f;
  EXPECT_NEAR(measure_errors(x, r).smape, 40, 1e-5);
  EXPECT_NEAR(*measure_errors(x, r).bias, 0.5, 1e-7);
  for (auto& p : x.pixels) p *= 1 / 3.0f;
  EXPECT_NEAR(*measure_errors(x, r).bias, -0.5, 1e-7);
}

TEST(Metrics, TheMaskKeepsOnlySurfaces) {
  Image x(3, 1), r(3, 1, glm::vec3(2));
  x.pixels = {glm::vec3(2), glm::vec3(100), glm::vec3(1)};
  const Errors e = measure_errors(x, r, {1, 0, 255});
  EXPECT_EQ(e.pixels, 2u);
  EXPECT_NEAR(e.rmse, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(*e.bias, -0.25, 1e-12);
  EXPECT_THROW(measure_errors(x, r, {0, 0, 0}), Error);
  EXPECT_THROW(measure_errors(x, r, {1, 1}), Error);
}

TEST(Metrics, ABlackReferenceHasNoRelativeError) {
  const Errors e = measure_errors(Image(2, 2, glm::vec3(1)), Image(2, 2));
  EXPECT_DOUBLE_EQ(e.smape, 200);
  EXPECT_DOUBLE_EQ(e.rmse, 1);
  EXPECT_FALSE(e.rrmse || e.mrse || e.bias || e.smape_lit || e.lit_share);
}

TEST(Metrics, SmapeOfTheLitPixelsLeavesTheDarkOut) {
  // Luminances of r: 0, 0.3, 0.5, 9.2; their mean is 2.5, a tenth of it 0.25.
  Image x(4, 1), r(4, 1);
  r.pixels = {glm::vec3(0), glm::vec3(0.3f), glm::vec3(0.5f), glm::vec3(9.2f)};
  x.pixels = {glm::vec3(5), glm::vec3(0.9f), glm::vec3(0.5f), glm::vec3(0)};
  const Errors e = measure_errors(x, r);
  EXPECT_NEAR(*e.smape_lit, 100 * (1.0 + 0 + 2) / 3, 1e-4);  // 0.6 / 0.6, 0, 2
  EXPECT_NEAR(*e.lit_share, 0.75, 1e-12);
  EXPECT_NEAR(e.smape, 100 * (2 + 1.0 + 0 + 2) / 4, 1e-4);
  // Without the brightest pixel the mean is 0.2667, and the mask's pixels alone count.
  EXPECT_NEAR(*measure_errors(x, r, {1, 1, 1, 0}).lit_share, 2.0 / 3, 1e-12);
  EXPECT_NEAR(*measure_errors(x, r, {1, 1, 0, 1}).lit_share, 1.0 / 3,
              1e-12);  // the mean is 3.17: 0.3 is dark
}

TEST(Metrics, SumsKeepTheirDigits) {
  // 2²⁰ pixels at 1000 and one error of 1: a float sum would lose it.
  const Image r(1024, 1024, glm::vec3(1000));
  Image x = r;
  x.at(5, 5) += glm::vec3(1);
  EXPECT_NEAR(*measure_errors(x, r).bias * 1000 * 1024 * 1024, 1, 1e-3);
}

TEST(Metrics, FormulasAreNamed) {
  EXPECT_EQ(formula(Metric::smape).id, "smape-0-200");
  EXPECT_EQ(formula(Metric::mrse).constants.at("epsilon_factor"), 0.01);
  EXPECT_EQ(formula(Metric::smape_lit).constants.at("lit_factor"), 0.1);
  EXPECT_NEAR(formula(Metric::flip).constants.at("pixels_per_degree"), 67.02, 0.01);
  std::vector<std::string> ids;
  for (const Metric m : kMetrics) ids.push_back(formula(m).id);
  EXPECT_EQ(formula(Metric::bias).name, "bias");
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
}

TEST(Health, CountsPixelsAndFindsTheFirst) {
  Image image(4, 3, glm::vec3(1));
  EXPECT_TRUE(check_health(image).finite());
  EXPECT_FALSE(check_health(image).first_bad);
  image.at(0, 0).x = -1;
  image.at(2, 1) = {kNaN, kNaN, kInf};
  image.at(3, 2).z = -kInf;
  const Health h = check_health(image);
  EXPECT_EQ(h.nan, 1u);
  EXPECT_EQ(h.inf, 2u);
  EXPECT_EQ(h.negative, 2u);  // −Inf is negative too
  EXPECT_EQ(h.first_bad, glm::uvec2(2, 1));
  EXPECT_FALSE(h.finite());
}

TEST(Health, BadPixelsAreNeverAveraged) {
  const Image r(2, 2, glm::vec3(1));
  for (const float bad : {kNaN, kInf, -kInf}) {
    Image x = r;
    x.at(1, 0).y = bad;
    EXPECT_THROW(measure_errors(x, r), Error);
    EXPECT_THROW(measure_errors(r, x), Error);
    EXPECT_THROW(error_quantiles(x, r), Error);
  }
  EXPECT_THROW(measure_errors(Image(2, 1), r), Error);
  EXPECT_THROW(measure_errors(Image(), Image()), Error);
}

TEST(Metrics, QuantilesOfTheRelativeError) {
  // 1000 pixels; pixel k has a relative error of k/999.
  Image r(1000, 1, glm::vec3(1)), x = r;
  for (int k = 0; k < 1000; ++k) {
    const float e = static_cast<float>(k) / 999;  // (x−1)/((x+1)/2) = e
    x.pixels[k] = glm::vec3((1 + e / 2) / (1 - e / 2));
  }
  const ErrorQuantiles q = error_quantiles(x, r);
  EXPECT_NEAR(q.p50, 50, 1e-3);
  EXPECT_NEAR(q.p99, 99, 1e-3);
  EXPECT_NEAR(q.p999, 99.9, 1e-3);
}

// A relative error is 200 % at most, however high a spike is.
TEST(Metrics, TheHeightOfSpikesIsOverTheMeansOfTheReference) {
  const Image r(1000, 1, glm::vec3(2));
  for (const float height : {10.0f, 1000.0f}) {
    Image x = r;
    for (int k = 0; k < 3; ++k) x.pixels[k] += glm::vec3(height);
    EXPECT_NEAR(*measure_errors(x, r).p99_9, height / 2, 1e-4 * height);
    Image one = r;
    one.pixels[0] += glm::vec3(height);  // in a thousandth of the pixels, less than the percentile's share
    EXPECT_LT(*measure_errors(one, r).p99_9, 0.01 * height);
  }
  EXPECT_FALSE(measure_errors(r, Image(1000, 1)).p99_9);
}

TEST(Metrics, ExposureMapsTheBrightTwentiethToTheKey) {
  Image r(100, 1);
  for (int k = 0; k < 100; ++k) r.pixels[k] = glm::vec3(static_cast<float>(k) / 99 * 20);
  EXPECT_NEAR(auto_exposure(r), 0.8f / 19, 1e-5);  // p95 = 19
  EXPECT_EQ(auto_exposure(Image(8, 8)), 1);
  EXPECT_EQ(auto_exposure(Image()), 1);
  Image spark(100, 1);
  spark.pixels[7] = glm::vec3(5);
  EXPECT_NEAR(auto_exposure(spark), 0.8f / 5, 1e-6);
}
