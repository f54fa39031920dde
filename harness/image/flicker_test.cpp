#include "image/flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"

using namespace vsglbench;

namespace {

struct Frame {
  Image x, r;
  Mask mask;
};

Image random_image(uint32_t w, uint32_t h, std::mt19937* random) {
  std::uniform_real_distribution<float> value(0, 4);
  Image image(w, h);
  for (auto& p : image.pixels) p = {value(*random), value(*random), value(*random)};
  return image;
}

std::vector<Frame> random_frames(uint32_t w, uint32_t h, size_t frames, uint32_t seed, bool masked) {
  std::mt19937 random(seed);
  std::vector<Frame> out;
  for (size_t t = 0; t < frames; ++t) {
    out.push_back({random_image(w, h, &random), random_image(w, h, &random), {}});
    if (!masked) continue;
    for (size_t i = 0; i < size_t(w) * h; ++i) out.back().mask.push_back(i == 0 || random() % 4 != 0);
  }
  return out;
}

DerivativeFlicker measure(const std::vector<Frame>& frames) {
  DerivativeFlickerMeter meter;
  for (const Frame& f : frames) meter.add(f.x, f.r, f.mask);
  return meter.finish().value();
}

bool kept(const Frame& f, size_t i) { return f.mask.empty() || f.mask[i] != 0; }

double channel(const Image& image, size_t i, int c) { return image.pixels[i][c]; }

// p-quantile of all values, sorted: between the two that stand beside p (n − 1).
double sorted_quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const size_t k = static_cast<size_t>(at);
  if (k + 1 == values.size()) return values[k];
  return values[k] * (1 - (at - k)) + values[k + 1] * (at - k);
}

// The definition, over the whole sequence.
DerivativeFlicker oracle(const std::vector<Frame>& frames) {
  const size_t pixels = frames[0].x.pixels.size();
  double reference = 0, references = 0;
  for (const Frame& f : frames)
    for (size_t i = 0; i < pixels; ++i)
      for (int c = 0; c < 3; ++c)
        if (kept(f, i)) reference += channel(f.r, i, c), ++references;
  DerivativeFlicker out;
  out.mean_reference = reference / references;
  const auto d = [&](size_t t, size_t i) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const Frame &a = frames[t - 1], &b = frames[t];
      sum += std::abs((channel(b.x, i, c) - channel(a.x, i, c)) - (channel(b.r, i, c) - channel(a.r, i, c)));
    }
    return sum / 3 / out.mean_reference;
  };
  double total = 0, count = 0, worst = -1;
  std::vector<double> of_pixels;
  for (size_t t = 1; t < frames.size(); ++t) {
    double sum = 0, n = 0;
    for (size_t i = 0; i < pixels; ++i)
      if (kept(frames[t - 1], i) && kept(frames[t], i)) sum += d(t, i), ++n;
    out.series.push_back(sum / n);
    if (sum / n > worst) worst = sum / n, out.worst_frame = t;
    total += sum, count += n;
  }
  for (size_t i = 0; i < pixels; ++i) {
    double sum = 0, n = 0;
    for (size_t t = 1; t < frames.size(); ++t)
      if (kept(frames[t - 1], i) && kept(frames[t], i)) sum += d(t, i), ++n;
    if (n > 0) of_pixels.push_back(sum / n);
  }
  out.value = total / count;
  out.p99 = sorted_quantile(of_pixels, 0.99);
  return out;
}

}  // namespace

TEST(DerivativeFlicker, IsTheDefinitionOverTheWholeSequence) {
  const std::tuple<uint32_t, uint32_t, size_t> sizes[] = {{1, 1, 2}, {7, 3, 5}, {33, 17, 9}, {2, 40, 3}};
  for (const auto& [w, h, frames] : sizes) {
    for (const bool masked : {false, true}) {
      const auto sequence = random_frames(w, h, frames, w + h, masked);
      const DerivativeFlicker got = measure(sequence), want = oracle(sequence);
      EXPECT_NEAR(got.value, want.value, 1e-12) << w << "x" << h;
      EXPECT_NEAR(got.p99, want.p99, 1e-12) << w << "x" << h;
      EXPECT_NEAR(got.mean_reference, want.mean_reference, 1e-12) << w << "x" << h;
      EXPECT_EQ(got.worst_frame, want.worst_frame) << w << "x" << h;
      ASSERT_EQ(got.series.size(), frames - 1);
      for (size_t k = 0; k + 1 < frames; ++k) EXPECT_NEAR(got.series[k], want.series[k], 1e-12) << k;
    }
  }
}

TEST(DerivativeFlicker, ByHand) {
  // Three frames of two pixels; x and r in all channels alike.
  const float x[3][2] = {{1, 5}, {2, 5}, {2, 1}}, r[3][2] = {{1, 4}, {1, 4}, {2, 4}};
  DerivativeFlickerMeter meter;
  for (int t = 0; t < 3; ++t) {
    Image test(2, 1), reference(2, 1);
    for (int i = 0; i < 2; ++i) test.pixels[i] = glm::vec3(x[t][i]), reference.pixels[i] = glm::vec3(r[t][i]);
    meter.add(test, reference);
  }
  // |1 − 0|, |0 − 0| in frame 1; |0 − 1|, |−4 − 0| in frame 2; mean(r) = 16 / 6.
  const DerivativeFlicker f = meter.finish().value();
  EXPECT_DOUBLE_EQ(f.value, 1.5 / (16.0 / 6));
  ASSERT_EQ(f.series.size(), 2u);
  EXPECT_DOUBLE_EQ(f.series[0], 0.5 / (16.0 / 6));
  EXPECT_DOUBLE_EQ(f.series[1], 2.5 / (16.0 / 6));
  EXPECT_EQ(f.worst_frame, 2u);
  EXPECT_DOUBLE_EQ(f.p99, (1 + 0.99 * (2 - 1)) / (16.0 / 6));  // pixels' means 1 and 2
  EXPECT_EQ(meter.sums(), (std::vector<double>{2, 4}));
}

TEST(DerivativeFlicker, ChannelsAreAveraged) {
  DerivativeFlickerMeter meter;
  const Image r(1, 1, glm::vec3(1));
  meter.add(r, r);
  Image x = r;
  x.pixels[0] = {4, 1, 0};
  meter.add(x, r);
  EXPECT_DOUBLE_EQ(meter.finish()->value, 4.0 / 3);
}

TEST(DerivativeFlicker, AStillSceneHasNoneToTheBit) {
  std::mt19937 random(3);
  const Image x = random_image(31, 7, &random), r = random_image(31, 7, &random);
  const DerivativeFlicker f = measure(std::vector<Frame>(16, Frame{x, r, {}}));
  EXPECT_EQ(f.value, 0.0);
  EXPECT_EQ(f.p99, 0.0);
  EXPECT_EQ(f.series, std::vector<double>(15, 0.0));
  EXPECT_EQ(f.worst_frame, 1u);
}

// The left half of a still picture is a fifth brighter in one odd frame and a fifth darker in another.
TEST(DerivativeFlicker, APlantedFlickerIsFoundInItsFrames) {
  const Image r(10, 4, glm::vec3(2));
  std::vector<Frame> frames(16, Frame{r, r, {}});
  for (const size_t t : {5, 9}) {
    for (uint32_t y = 0; y < 4; ++y)
      for (uint32_t u = 0; u < 5; ++u) frames[t].x.at(u, y) *= t == 5 ? 1.2f : 0.8f;
  }
  const DerivativeFlicker f = measure(frames);
  for (size_t t = 1; t < 16; ++t) {
    const bool changed = t == 5 || t == 6 || t == 9 || t == 10;
    EXPECT_NEAR(f.series[t - 1], changed ? 0.1 : 0, 1e-6) << t;
  }
  EXPECT_NEAR(f.value, 4 * 0.1 / 15, 1e-6);
  EXPECT_NEAR(f.p99, 4 * 0.2 / 15, 1e-6);
  EXPECT_TRUE(std::ranges::count(std::vector<uint64_t>{5, 6, 9, 10}, f.worst_frame)) << f.worst_frame;
}

// A picture of one frame ago is off by the difference of two changes.
TEST(DerivativeFlicker, ALagCounts) {
  const auto reference = [](float t) { return Image(5, 3, glm::vec3(1 + t * t)); };
  DerivativeFlickerMeter prompt, late;
  for (int t = 0; t < 8; ++t) {
    const Image r = reference(static_cast<float>(t));
    prompt.add(r, r);
    late.add(t == 0 ? r : reference(static_cast<float>(t - 1)), r);
  }
  EXPECT_EQ(prompt.finish()->value, 0.0);
  const DerivativeFlicker f = late.finish().value();
  // r_t − r_{t−1} = 2t − 1, and x is one frame behind: 1 at t = 1, else 2. mean(r) = 1 + 140 / 8.
  EXPECT_NEAR(f.series[0], 1 / 18.5, 1e-12);
  for (size_t k = 1; k < 7; ++k) EXPECT_NEAR(f.series[k], 2 / 18.5, 1e-12);
}

TEST(DerivativeFlicker, WhatStaysOrMovesAlikeDoesNotCount) {
  std::mt19937 random(4);
  DerivativeFlickerMeter meter;
  for (int t = 0; t < 6; ++t) {
    Image r(9, 5);
    for (auto& p : r.pixels) p = glm::vec3(static_cast<float>(random() % 1024) / 16);
    Image x = r;
    for (auto& p : x.pixels) p += glm::vec3(0.5f, 3, 70);  // exact
    meter.add(x, r);
  }
  EXPECT_EQ(meter.finish()->value, 0.0);
}

// A pixel that shows a surface in every other frame never counts, and its reference does.
TEST(DerivativeFlicker, PixelsCountWhereTwoFramesShowASurface) {
  const Image r(2, 1, glm::vec3(1));
  DerivativeFlickerMeter meter;
  for (int t = 0; t < 5; ++t) {
    Image x = r, reference = r;
    x.pixels[1] = glm::vec3(static_cast<float>(100 * t));
    reference.pixels[1] = glm::vec3(t % 2 == 0 ? 6.0f : 1e6f);
    meter.add(x, reference, {1, static_cast<uint8_t>(t % 2 == 0)});
  }
  const DerivativeFlicker f = meter.finish().value();
  EXPECT_EQ(f.value, 0.0);
  EXPECT_EQ(f.p99, 0.0) << "of the pixels that count";
  EXPECT_DOUBLE_EQ(f.mean_reference, (5 * 1 + 3 * 6) / 8.0);
  EXPECT_EQ(meter.sums()[1], 0.0);
}

TEST(DerivativeFlicker, RefusesWhatItCannotTell) {
  const Image r(3, 2, glm::vec3(1));
  DerivativeFlickerMeter meter;
  EXPECT_THROW(meter.finish(), Error);
  EXPECT_THROW(meter.add(Image(), Image()), Error) << "no pixels";
  EXPECT_THROW(meter.add(r, r, Mask(6, 0)), Error) << "no surface";
  meter.add(r, r);
  EXPECT_THROW(meter.finish(), Error) << "one frame";
  EXPECT_THROW(meter.add(Image(2, 3, glm::vec3(1)), Image(2, 3, glm::vec3(1))), Error) << "another size";
  EXPECT_THROW(meter.add(r, r, Mask(6, 0)), Error) << "no surface in both";
  EXPECT_THROW(meter.add(r, r, Mask(5, 1)), Error);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image x = r;
    x.at(1, 1).y = bad;
    EXPECT_THROW(meter.add(x, r), Error);
    EXPECT_THROW(meter.add(r, x), Error);
    EXPECT_THROW(meter.add(x, r, {1, 1, 1, 1, 0, 1}), Error) << "also on the background";
  }
  EXPECT_EQ(meter.frames(), 1u) << "what was refused is not counted";
  Image x = r;
  x.at(0, 0) = glm::vec3(7);
  meter.add(x, r);
  EXPECT_DOUBLE_EQ(meter.finish()->value, 1);
  DerivativeFlickerMeter black;
  black.add(r, Image(3, 2));
  black.add(x, Image(3, 2));
  EXPECT_FALSE(black.finish()) << "a black reference has no relative flicker";
}

TEST(DerivativeFlicker, TheFormulaIsNamed) {
  EXPECT_EQ(derivative_flicker_formula().id, "flicker-derivative-mean-reference");
}
