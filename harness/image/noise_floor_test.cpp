// The floor against what it stands for: the error of the true image, which a simulation knows.
#include "image/noise_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "image/flip.h"

using namespace vsglbench;

namespace {

using Noise = std::function<double(std::mt19937&)>;  // of mean 0 and standard deviation 1

const Noise kGaussian = [](std::mt19937& random) { return std::normal_distribution<double>()(random); };
const Noise kExponential = [](std::mt19937& random) {
  return std::exponential_distribution<double>()(random) - 1;
};

struct Samples {
  Image truth{64, 48}, half[2] = {{64, 48}, {64, 48}}, mean{64, 48};
};

// Halves whose noise is `relative` of the pixel's true value.
Samples simulate(double relative, const Noise& noise) {
  Samples s;
  std::mt19937 random(7);
  for (size_t i = 0; i < s.truth.pixels.size(); ++i) {
    const double x = static_cast<double>(i % 64) / 64, y = static_cast<double>(i / 64) / 48;
    for (int c = 0; c < 3; ++c) {
      const double t = 0.2 + x * x + 0.5 * y * c + (x > 0.7 ? 3 : 0);
      s.truth.pixels[i][c] = static_cast<float>(t);
      for (auto& half : s.half) half.pixels[i][c] = static_cast<float>(t * (1 + relative * noise(random)));
      s.mean.pixels[i][c] = 0.5f * (s.half[0].pixels[i][c] + s.half[1].pixels[i][c]);
    }
  }
  return s;
}

NoiseFloor floor_of(const Samples& s) { return noise_floor_of(s.half[0], s.half[1], s.mean, {}); }

}  // namespace

TEST(NoiseFloor, IsWhatTheTrueImageWouldShow) {
  for (const double relative : {0.01, 0.03, 0.1}) {
    const Samples s = simulate(relative, kGaussian);
    const NoiseFloor floor = floor_of(s);
    const Errors truth = measure_errors(s.truth, s.mean);
    EXPECT_NEAR(floor.smape / truth.smape, 1, 0.04) << relative;
    EXPECT_NEAR(*floor.smape_lit / *truth.smape_lit, 1, 0.04) << relative;
    EXPECT_NEAR(floor.rmse / truth.rmse, 1, 0.04) << relative;
    EXPECT_NEAR(*floor.rrmse / *truth.rrmse, 1, 0.04) << relative;
    EXPECT_NEAR(*floor.mrse / *truth.mrse, 1, 0.1) << relative;
    const double flip = *flip_floor_of(s.half[0], s.half[1], s.mean, {});
    EXPECT_NEAR(flip / measure_flip(s.truth, s.mean)->mean, 1, 0.05) << relative;
  }
}

// Where a pixel's noise is not small beside it, that M's error and M go together matters.
TEST(NoiseFloor, OfStrongNoiseIsOfTheSameSize) {
  const Samples s = simulate(0.3, kGaussian);
  const NoiseFloor floor = floor_of(s);
  const Errors truth = measure_errors(s.truth, s.mean);
  EXPECT_NEAR(floor.rmse / truth.rmse, 1, 0.04);
  EXPECT_NEAR(floor.smape / truth.smape, 1.06, 0.03);
  EXPECT_NEAR(*floor.mrse / *truth.mrse, 0.68, 0.05);
  EXPECT_NEAR(*flip_floor_of(s.half[0], s.half[1], s.mean, {}) / measure_flip(s.truth, s.mean)->mean, 1.07,
              0.03);
}

TEST(NoiseFloor, OfSkewedNoiseIsOfTheSameSize) {
  const Samples s = simulate(1, kExponential);
  const NoiseFloor floor = floor_of(s);
  const Errors truth = measure_errors(s.truth, s.mean);
  EXPECT_NEAR(floor.rmse / truth.rmse, 1, 0.05);  // squares do not see the sign
  EXPECT_NEAR(floor.smape / truth.smape, 1, 0.25);
}

// What the halves show against each other: twice as much, and four times.
TEST(NoiseFloor, IsOfTheMeanAndNotOfAHalf) {
  const Samples s = simulate(0.05, kGaussian);
  const NoiseFloor floor = floor_of(s);
  const Errors halves = measure_errors(s.half[0], s.half[1]);
  EXPECT_NEAR(floor.rmse, 0.5 * halves.rmse, 1e-5 * halves.rmse);
  EXPECT_NEAR(floor.smape, 0.5 * halves.smape, 0.01 * halves.smape);
  EXPECT_NEAR(*floor.mrse, 0.25 * *halves.mrse, 0.03 * *halves.mrse);
}

TEST(NoiseFloor, FallsWithTheRootOfTheSamples) {
  const double ratio = floor_of(simulate(0.1, kGaussian)).smape / floor_of(simulate(0.05, kGaussian)).smape;
  EXPECT_NEAR(ratio, 2, 0.02);
}

TEST(NoiseFloor, OfABlackReferenceIsNoneWhereItHasToBeRelative) {
  const Image black(8, 8);
  EXPECT_EQ(noise_floor_of(black, black, black, {}).rmse, 0);
  EXPECT_FALSE(noise_floor_of(black, black, black, {}).mrse);
  EXPECT_FALSE(flip_floor_of(black, black, black, {}));
}
