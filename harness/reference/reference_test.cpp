#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "reference/test_scenes.h"

namespace vsglbench {
namespace {

ReferenceParameters small(uint32_t samples, uint32_t strategies = strategy_all) {
  ReferenceParameters p;
  p.width = 64;
  p.height = 48;
  p.samples = samples;
  p.batches = 32;
  p.photons_a_sample = 1;
  p.strategies = strategies;
  p.threads = 2;
  return p;
}

// How two estimates of one image differ, in units of their own standard errors.
struct Agreement {
  double mean_z = 0, std_z = 0;  // over blocks of 8x8 pixels
  double image_z = 0;            // of the image means
  double relative = 0;           // difference of the image means
  double error = 0;              // its standard error
};

// Independent runs with seeds of their own. Pixels of a run share their x1, so only runs tell how a sum over
// pixels scatters.
using Runs = std::vector<ReferenceResult>;
constexpr int kRuns = 8;

Runs run(const Tracer& tracer, ReferenceParameters p) {
  p.samples /= kRuns;
  p.batches = 4;
  p.seed *= kRuns;
  Runs runs;
  for (int i = 0; i < kRuns; ++i, ++p.seed) runs.push_back(compute_reference(tracer, p));
  return runs;
}

struct Estimate {
  double mean = 0, variance = 0;  // of the mean
};

// Green, which stands for all channels since they share their samples, summed over a rectangle.
Estimate sum_over(const Runs& runs, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height) {
  Estimate e;
  double squares = 0;
  for (const ReferenceResult& r : runs) {
    double sum = 0;
    for (uint32_t i = 0; i < width * height; ++i) sum += r.mean.at(x0 + i % width, y0 + i / width).y;
    e.mean += sum / kRuns, squares += sum * sum;
  }
  e.variance = std::max(0.0, squares - kRuns * e.mean * e.mean) / (kRuns * (kRuns - 1));
  return e;
}

// Blocks of 8x8, which share no x1 but the pool's, and because a pixel's estimate by one strategy alone is
// too skewed for its z to be near normal.
Agreement compare(const Runs& a, const Runs& b) {
  Agreement g;
  double n = 0, squares = 0;
  const uint32_t width = a[0].mean.width, height = a[0].mean.height;
  for (uint32_t y = 0; y + 8 <= height; y += 8) {
    for (uint32_t x = 0; x + 8 <= width; x += 8) {
      const Estimate ea = sum_over(a, x, y, 8, 8), eb = sum_over(b, x, y, 8, 8);
      const double d = ea.mean - eb.mean, v = ea.variance + eb.variance;
      if (!(v > 0)) continue;
      g.mean_z += d / std::sqrt(v), squares += d * d / v, n += 1;
    }
  }
  g.mean_z /= n;
  g.std_z = std::sqrt(squares / n - g.mean_z * g.mean_z);
  const Estimate ea = sum_over(a, 0, 0, width, height), eb = sum_over(b, 0, 0, width, height);
  const double difference = ea.mean - eb.mean, variance = ea.variance + eb.variance;
  g.image_z = difference / std::sqrt(variance);
  g.relative = difference / eb.mean;
  g.error = std::sqrt(variance) / eb.mean;
  return g;
}

void expect_agreement(const Runs& a, const Runs& b, const std::string& what) {
  const Agreement g = compare(a, b);
  // Student's z of twice eight runs deviates by 1.08. 48 blocks: three standard errors of its mean are 0.47,
  // of its deviation 0.33; and 3.64 has the odds of three standard errors of a normal one.
  EXPECT_LT(std::abs(g.mean_z), 0.47) << what;
  EXPECT_NEAR(g.std_z, 1.08, 0.33) << what;
  EXPECT_LT(std::abs(g.image_z), 3.64) << what << ": images differ by " << 100 * g.relative << " %";
  EXPECT_LT(g.error, 0.015) << what << ": too noisy to tell 5 % apart";
}

void expect_strategies_agree(const Scene& scene, bool occlusion, uint32_t samples) {
  const Tracer tracer(scene);
  const std::pair<uint32_t, std::string> one[] = {{strategy_light, "light"},
                                                  {strategy_receiver, "receiver"},
                                                  {strategy_emitter, "emitter"},
                                                  {strategy_all, "all"}};
  std::vector<Runs> results;
  for (const auto& [strategies, name] : one) {
    ReferenceParameters p = small(samples, strategies);
    p.occlusion = occlusion;
    p.seed = 100 + strategies;  // independent images
    results.push_back(run(tracer, p));
  }
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = i + 1; j < 4; ++j)
      expect_agreement(results[i], results[j], one[i].second + " against " + one[j].second);
  }
}

TEST(Reference, StrategiesAgreeInADiffuseRoom) { expect_strategies_agree(test::slab_box(), true, 512); }

TEST(Reference, StrategiesAgreeWithoutOcclusion) { expect_strategies_agree(test::slab_box(), false, 512); }

TEST(Reference, StrategiesAgreeWithGlossyEmitterAndReceiver) {
  Material glossy = test::lambert({0.4f, 0.4f, 0.4f});
  glossy.specular = 1;
  glossy.phong_exponent = 20;
  Scene scene = test::slab_box(test::mirror(30, {0.9f, 0.7f, 0.5f}));
  scene.materials[0] = glossy;
  expect_strategies_agree(scene, true, 1024);
}

TEST(Reference, ConvexRoomNeedsNoOcclusionTest) {
  ReferenceParameters p = small(256);
  const Scene scene = test::empty_box();
  const Tracer tracer(scene);
  const ReferenceResult with = compute_reference(tracer, p);
  p.occlusion = false;
  const ReferenceResult without = compute_reference(tracer, p);
  double sum_with = 0, sum_without = 0, differing = 0;
  for (size_t i = 0; i < with.mask.size(); ++i) {
    sum_with += with.mean.pixels[i].y;
    sum_without += without.mean.pixels[i].y;
    differing += std::abs(with.mean.pixels[i].y - without.mean.pixels[i].y) > 1e-3f * with.mean.pixels[i].y;
  }
  // The same samples: only rays through edges may differ.
  EXPECT_NEAR(sum_with / sum_without, 1, 1e-3);
  EXPECT_LT(differing, 0.03 * double(with.mask.size()));
}

TEST(Reference, OcclusionDarkensARoomWithASlab) {
  ReferenceParameters p = small(128);
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  const Runs with = run(tracer, p);
  p.occlusion = false;
  const Agreement g = compare(with, run(tracer, p));
  EXPECT_LT(g.image_z, -10);
  EXPECT_LT(g.relative, -0.02);
}

TEST(Reference, SameSeedSameBitsOnAnyNumberOfThreads) {
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  ReferenceParameters p = small(64);
  p.threads = 1;
  const ReferenceResult one = compute_reference(tracer, p);
  for (const unsigned threads : {1u, 2u, 5u}) {
    p.threads = threads;
    const ReferenceResult other = compute_reference(tracer, p);
    EXPECT_EQ(one.mean.pixels, other.mean.pixels) << threads;
    EXPECT_EQ(one.variance.pixels, other.variance.pixels) << threads;
    EXPECT_EQ(one.half[1].pixels, other.half[1].pixels) << threads;
    EXPECT_EQ(one.rays, other.rays);
    EXPECT_EQ(one.hash, other.hash);
  }
  p.seed = 2;
  EXPECT_NE(compute_reference(tracer, p).mean.pixels, one.mean.pixels);
}

// The variance it states is the scatter it has: over independent runs.
TEST(Reference, StatedVarianceIsTheScatterBetweenSeeds) {
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  ReferenceParameters p = small(64);
  constexpr int runs = 12;
  std::vector<ReferenceResult> results;
  for (int i = 0; i < runs; ++i) {
    p.seed = 1000 + i;
    results.push_back(compute_reference(tracer, p));
  }
  double stated = 0, scatter = 0;
  for (size_t i = 0; i < results[0].mask.size(); ++i) {
    double sum = 0, squares = 0;
    for (const ReferenceResult& r : results) {
      const double x = r.mean.pixels[i].y;
      sum += x, squares += x * x, stated += r.variance.pixels[i].y / runs;
    }
    scatter += (squares - sum * sum / runs) / (runs - 1);
  }
  EXPECT_NEAR(scatter / stated, 1, 0.15);
  // Halves differ by twice the standard error of the mean.
  EXPECT_GT(results[0].noise_floor_smape, 0);
}

TEST(Reference, NoiseFallsWithSamples) {
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  const double few = compute_reference(tracer, small(64)).noise_floor_smape;
  const double many = compute_reference(tracer, small(1024)).noise_floor_smape;
  EXPECT_LT(many, few / 3);  // 1/sqrt(16), or better by stratification
}

// A directional light: the same three strategies over another plane.
TEST(Reference, StrategiesAgreeUnderASun) {
  Scene scene = test::slab_box();
  scene.light.type = Light::Type::directional;
  scene.light.half_extent = {0.25f, 0.2f};
  expect_strategies_agree(scene, true, 2048);
}

// A room a million times smaller, lit by 1e-12 of the intensity, looks the same.
TEST(Reference, AMicrometreRoomIsARoom) {
  const auto room = [](double unit) {
    std::vector<test::Quad> quads = test::box_quads();
    for (test::Quad& q : quads) q.corner *= unit, q.a *= unit, q.b *= unit;
    Light light = test::spot(glm::vec3(0.5f, 0.95f, 0.5f) * float(unit), {0.5f, -1, -0.3f}, 0.9f);
    light.power *= float(unit * unit);
    return test::make_scene(
        quads, {test::mirror(30, {0.9f, 0.7f, 0.5f}), test::lambert({0.6f, 0.1f, 0.1f}), Material()}, light,
        test::camera_at(glm::vec3(0.3f, 0.5f, 0.95f) * float(unit), glm::vec3(0.5f, 0.4f, 0) * float(unit),
                        1));
  };
  const ReferenceParameters p = small(256);
  const ReferenceResult metre = compute_reference(room(1), p), micrometre = compute_reference(room(1e-6), p);
  double a = 0, b = 0;
  for (size_t i = 0; i < metre.mask.size(); ++i)
    a += metre.mean.pixels[i].y, b += micrometre.mean.pixels[i].y;
  EXPECT_GT(a, 0);
  EXPECT_NEAR(b / a, 1, 0.01);
}

TEST(Reference, SaysWhatItCannotRender) {
  const auto kind_of = [](const Scene& scene, const ReferenceParameters& p) {
    try {
      compute_reference(scene, p);
    } catch (const Error& e) {
      EXPECT_GT(std::string(e.what()).size(), 20u);
      return e.kind();
    }
    ADD_FAILURE() << "no error";
    return ErrorKind::device;
  };
  Scene dark = test::empty_box();
  dark.light.position = {0, 50, 0};
  dark.light.direction = {0, 1, 0};
  EXPECT_EQ(kind_of(dark, small(16)), ErrorKind::case_failed);
  Scene blind = test::empty_box();
  blind.camera.position = {0, 50, 0};
  blind.camera.direction = {0, 1, 0};
  blind.camera.up = {0, 0, 1};
  EXPECT_EQ(kind_of(blind, small(16)), ErrorKind::case_failed);
  ReferenceParameters p = small(16);
  p.width = 0;
  EXPECT_EQ(kind_of(test::empty_box(), p), ErrorKind::config);
  p = small(0);
  EXPECT_EQ(kind_of(test::empty_box(), p), ErrorKind::config);
  p = small(16);
  p.batches = 3;
  EXPECT_EQ(kind_of(test::empty_box(), p), ErrorKind::config);
}

}  // namespace
}  // namespace vsglbench
