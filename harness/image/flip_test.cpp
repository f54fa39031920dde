// FLIP against the papers' formulas, written out again in double: two-dimensional filters, pixel by pixel,
// and colour spaces from the primaries of Rec.709.
#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "base/error.h"

using namespace vsglbench;

namespace {

using Color = glm::dvec3;
constexpr double kPi = std::numbers::pi, kPixels = 0.7 * 3840 / 0.7 * kPi / 180;

// --- colour, from the chromaticities of IEC 61966-2-1 ---

Color from_chromaticity(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

const Color kWhite = from_chromaticity(0.3127, 0.3290);

glm::dmat3 rgb_to_xyz() {
  const glm::dmat3 primaries(from_chromaticity(0.64, 0.33), from_chromaticity(0.3, 0.6),
                             from_chromaticity(0.15, 0.06));
  const Color share = glm::inverse(primaries) * kWhite;
  return {primaries[0] * share.x, primaries[1] * share.y, primaries[2] * share.z};
}

Color ycxcz(Color rgb) {
  const Color t = rgb_to_xyz() * rgb / kWhite;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

Color rgb_of(Color ycxcz) {
  const double y = (ycxcz.x + 16) / 116;
  return glm::inverse(rgb_to_xyz()) * (Color(y + ycxcz.y / 500, y, y - ycxcz.z / 200) * kWhite);
}

Color hunt_lab(Color rgb) {
  const auto f = [](double t) { return t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29; };
  const Color t = rgb_to_xyz() * rgb / kWhite;
  const double lightness = 116 * f(t.y) - 16;
  return {lightness, lightness / 100 * 500 * (f(t.x) - f(t.y)), lightness / 100 * 200 * (f(t.y) - f(t.z))};
}

double powered_distance(Color p, Color q) {
  return std::pow(std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z), 0.7);
}

double error_of_colors(Color rgb1, Color rgb2) {
  const double largest = powered_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
  const double distance = powered_distance(hunt_lab(rgb1), hunt_lab(rgb2));
  if (distance < 0.4 * largest) return 0.95 * distance / (0.4 * largest);
  return 0.95 + 0.05 * (distance - 0.4 * largest) / (0.6 * largest);
}

double tone(double x) {
  const double t = 0.6 * x;  // what the fit's own exposure takes away
  return std::clamp(t * (2.51 * t + 0.03) / (t * (2.43 * t + 0.59) + 0.14), 0.0, 1.0);
}

Color tone(Color c) { return {tone(c.x), tone(c.y), tone(c.z)}; }

double white_point() {
  double lo = 0, hi = 12;
  for (int i = 0; i < 100; ++i) (tone(0.5 * (lo + hi)) < 0.85 ? lo : hi) = 0.5 * (lo + hi);
  return lo;
}

// --- filters: weights over a square, by the formulas ---

using Kernel = std::function<double(int x, int y)>;
using Picture = std::function<Color(int x, int y)>;

Color blur(const Picture& picture, const Kernel& kernel, int radius) {
  Color sum(0);
  double weights = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      sum += kernel(x, y) * picture(x, y);
      weights += kernel(x, y);
    }
  }
  return sum / weights;
}

// Weights above 0 scaled to a sum of 1, those below to −1.
double detect(const Picture& picture, const Kernel& kernel, int radius) {
  double above = 0, below = 0, above_weights = 0, below_weights = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const double w = kernel(x, y), value = w * (picture(x, y).x + 16) / 116;
      (w > 0 ? above : below) += value;
      (w > 0 ? above_weights : below_weights) += w;
    }
  }
  return above / above_weights - below / below_weights;
}

Kernel sensitivity(double a1, double b1, double a2, double b2) {
  return [=](int x, int y) {
    const double z2 = (x * x + y * y) / (kPixels * kPixels);
    return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * z2 / b1) +
           a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * z2 / b2);
  };
}

struct Seen {
  Color rgb;
  double edge = 0, point = 0;
};

Seen look(const Picture& picture) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * kPixels));
  const Color blurred(blur(picture, sensitivity(1, 0.0047, 0, 1e-5), radius).x,
                      blur(picture, sensitivity(1, 0.0053, 0, 1e-5), radius).y,
                      blur(picture, sensitivity(34.1, 0.04, 13.5, 0.025), radius).z);
  const double s = 0.5 * 0.082 * kPixels;
  const auto gaussian = [=](int x, int y) { return std::exp(-(x * x + y * y) / (2 * s * s)); };
  const Kernel edge = [=](int x, int y) { return -x * gaussian(x, y); };
  const Kernel point = [=](int x, int y) { return (x * x / (s * s) - 1) * gaussian(x, y); };
  const auto length = [&](const Kernel& k) {
    const int r = static_cast<int>(std::ceil(3 * s));
    return std::hypot(detect(picture, k, r), detect(
                                                 picture, [&](int x, int y) { return k(y, x); }, r));
  };
  return {glm::clamp(rgb_of(blurred), 0.0, 1.0), length(edge), length(point)};
}

double oracle(const Image& x, const Image& r, int px, int py, const FlipExposures& exposures) {
  double worst = 0;
  for (uint32_t e = 0; e < exposures.count; ++e) {
    const double scale =
        std::exp2(exposures.start + (exposures.stop - exposures.start) * e / (exposures.count - 1));
    const auto around = [&](const Image& image) {
      return [&, px, py](int dx, int dy) {
        const int u = std::clamp(px + dx, 0, static_cast<int>(image.width) - 1);
        const int v = std::clamp(py + dy, 0, static_cast<int>(image.height) - 1);
        return ycxcz(tone(scale * Color(image.at(u, v))));
      };
    };
    const Seen a = look(around(x)), b = look(around(r));
    const double feature = std::max(std::abs(a.edge - b.edge), std::abs(a.point - b.point)) / std::sqrt(2.0);
    worst = std::max(worst, std::pow(error_of_colors(a.rgb, b.rgb), 1 - std::sqrt(feature)));
  }
  return worst;
}

// Blobs, an edge and noise.
Image scene(uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Image image(37, 23);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      image.at(x, y) = glm::vec3(0.05f) + 0.1f * glm::vec3(value(random), value(random), value(random));
      if (x > 20) image.at(x, y) += glm::vec3(2, 0.5f, 0.1f) * (seed == 1 ? 1.0f : 0.8f);
      if (x == 9 && y == 11) image.at(x, y) += glm::vec3(0, 20, 60) * (seed == 1 ? 1.0f : 0.0f);
    }
  }
  return image;
}

}  // namespace

TEST(Flip, OfConstantImagesIsTheDistanceOfTheirColours) {
  const std::pair<glm::vec3, glm::vec3> pairs[] = {{glm::vec3(0.5f), glm::vec3(0.25f)},
                                                   {{1, 0, 0}, {0, 1, 0}},
                                                   {{0.2f, 0.3f, 0.1f}, {0.21f, 0.3f, 0.1f}},
                                                   {{40, 50, 60}, glm::vec3(0)},
                                                   {glm::vec3(1e-6f), glm::vec3(2e-6f)}};
  for (const auto& [r, x] : pairs) {
    const auto flip = measure_flip(Image(24, 9, x), Image(24, 9, r));
    ASSERT_TRUE(flip);
    // Largest and median luminance are the same: both exposures take it to 0.85.
    const double luminance = 0.2126 * r.x + 0.7152 * r.y + 0.0722 * r.z, scale = white_point() / luminance;
    EXPECT_NEAR(flip->exposures.start, std::log2(scale), 1e-6);
    EXPECT_EQ(flip->exposures.count, 2u);
    const double expected = error_of_colors(tone(scale * Color(r)), tone(scale * Color(x)));
    EXPECT_NEAR(flip->mean, expected, 1e-4) << r.x << ' ' << x.x;
    EXPECT_NEAR(flip->p99, flip->mean, 1e-5);
  }
}

TEST(Flip, EveryPixelIsThatOfTheFormulas) {
  const Image r = scene(1), x = scene(2);
  const FlipExposures exposures = *flip_exposures(r);
  EXPECT_GE(exposures.count, 4u);
  const Plane map = FlipReference(r, {}, exposures).error_map(x);
  const glm::ivec2 places[] = {{0, 0}, {36, 22}, {9, 11}, {12, 11}, {20, 5}, {21, 22}, {24, 12}, {3, 19}};
  for (const auto& p : places) {
    EXPECT_NEAR(map.values[p.y * r.width + p.x], oracle(x, r, p.x, p.y, exposures), 3e-4)
        << p.x << ' ' << p.y;
  }
}

// What is darker than the median differs most at the last exposure, what is brightest at the first.
TEST(Flip, TheWorstExposureCounts) {
  Image r(40, 30, glm::vec3(1)), x = r;
  for (uint32_t y = 0; y < 30; ++y) {
    for (uint32_t u = 0; u < 12; ++u) {
      r.at(u, y) = glm::vec3(1.0f / 32);
      x.at(u, y) = glm::vec3(1.5f / 32);
    }
    for (uint32_t u = 34; u < 40; ++u) {
      r.at(u, y) = glm::vec3(16);
      x.at(u, y) = glm::vec3(12);
    }
  }
  const FlipExposures all = *flip_exposures(r);
  ASSERT_EQ(all.count, 4u);
  const Plane map = FlipReference(r, {}, all).error_map(x);
  for (const auto& [u, e] : {std::pair{0, 3u}, {39, 0u}}) {
    const FlipExposures one{all.exposure(e), all.exposure(e), 2};
    EXPECT_NEAR(map.values[15 * 40 + u], oracle(x, r, u, 15, one), 3e-4) << u;
    EXPECT_NEAR(map.values[15 * 40 + u], oracle(x, r, u, 15, all), 3e-4) << u;
  }
}

TEST(Flip, AnImageAgainstItselfHasNoError) {
  const Image r = scene(1);
  const auto flip = measure_flip(r, r);
  EXPECT_EQ(flip->mean, 0);
  EXPECT_EQ(flip->p99, 0);
}

TEST(Flip, MeanAndP99AreOverThePixels) {
  const Image r = scene(1), x = scene(2);
  const FlipReference reference(r, {}, *flip_exposures(r));
  std::vector<float> values = reference.error_map(x).values;
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const float v : values) sum += v;
  const FlipErrors e = reference.compare(x);
  EXPECT_NEAR(e.mean, sum / static_cast<double>(values.size()), 1e-9);
  const double rank = 0.99 * static_cast<double>(values.size() - 1);
  EXPECT_GE(e.p99, values[static_cast<size_t>(rank)]);
  EXPECT_LE(e.p99, values[static_cast<size_t>(rank) + 1]);
}

TEST(Flip, ExposuresRunFromTheLargestToTheMedianLuminance) {
  Image r(5, 1);
  for (int i = 0; i < 5; ++i)
    r.pixels[i] = glm::vec3(std::exp2(static_cast<float>(2 * i)));  // 1 … 256, median 16
  const FlipExposures e = *flip_exposures(r);
  EXPECT_NEAR(e.start, std::log2(white_point() / 256), 1e-6);
  EXPECT_NEAR(e.stop - e.start, 4, 1e-6);
  EXPECT_EQ(e.exposure(e.count - 1), e.stop);
  EXPECT_NEAR(tone(std::exp2(e.start) * 256), 0.85, 1e-6);
}

TEST(Flip, WithoutAMedianTheRangeIsThatOfTheLitPixels) {
  Image r(9, 1);
  r.pixels[3] = glm::vec3(8);
  r.pixels[5] = glm::vec3(1);
  r.pixels[6] = glm::vec3(1);
  EXPECT_NEAR(flip_exposures(r)->stop - flip_exposures(r)->start, 3, 1e-6);
  r.pixels[5] = r.pixels[6] = glm::vec3(1e-20f);  // 66 stops below
  EXPECT_NEAR(flip_exposures(r)->stop - flip_exposures(r)->start, kFlipMostStops, 1e-6);
  EXPECT_EQ(flip_exposures(r)->count, 16u);
  EXPECT_FALSE(flip_exposures(Image(9, 1)));
  EXPECT_FALSE(measure_flip(r, Image(9, 1)));
}

TEST(Flip, PixelsWithoutASurfaceAreBlackAndNotCounted) {
  Image r = scene(1), x = scene(2);
  Mask mask(r.pixels.size(), 1);
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = i % r.width < 30;
  Image black_r = r, black_x = x;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) black_r.pixels[i] = black_x.pixels[i] = glm::vec3(0);
    if (!mask[i]) r.pixels[i] = x.pixels[i] = glm::vec3(1e6f, 3, static_cast<float>(i));
  }
  const FlipExposures exposures = *flip_exposures(r, mask);
  const Plane black = FlipReference(black_r, {}, exposures).error_map(black_x);
  double sum = 0, kept = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i]) sum += black.values[i];
    kept += mask[i];
  }
  EXPECT_NEAR(measure_flip(x, r, mask)->mean, sum / kept, 1e-6);
}

TEST(Flip, NothingBecomesNaN) {
  const Image r = scene(1);
  Image x = r;
  x.at(3, 3) = glm::vec3(3e38f);
  x.at(5, 3) = glm::vec3(-7);
  const auto flip = measure_flip(x, r);
  EXPECT_GT(flip->mean, 0);
  EXPECT_LE(flip->p99, 1);
  Image wide(6, 6, glm::vec3(1e-30f));  // 166 stops: the scale alone is 2¹⁰⁰
  wide.at(2, 2) = glm::vec3(1e20f);
  EXPECT_EQ(measure_flip(wide, wide)->mean, 0);
  // Scaled by 2⁶⁴ both are white, though the square of one is beyond a float.
  const Image bright(6, 6, glm::vec3(1)), brighter(6, 6, glm::vec3(1.05f));
  EXPECT_EQ(FlipReference(bright, {}, {64.08, 64.08, 2}).compare(brighter).mean, 0);
  x.at(0, 0).x = std::nanf("");
  EXPECT_THROW(measure_flip(x, r), Error);
  EXPECT_THROW(measure_flip(Image(3, 3), r), Error);
  EXPECT_THROW(measure_flip(r, r, Mask(r.pixels.size(), 0)), Error);
}
