#include "reference/noise.h"

#include <gtest/gtest.h>

#include "base/percent.h"
#include "reference/reference.h"
#include "reference/test_scenes.h"

namespace vsglbench {
namespace {

ReferenceParameters tiny(uint32_t samples) {
  ReferenceParameters p;
  p.width = 32;
  p.height = 24;
  p.samples = samples;
  p.batches = 8;
  p.threads = 2;
  return p;
}

// A room under a sun that lights a rectangle 60 times larger than its floor: few rays of the light count, as
// in an atrium under a roof.
Scene atrium() {
  Scene scene = test::slab_box();
  scene.light.type = Light::Type::directional;
  scene.light.half_extent = {4, 4};
  return scene;
}

struct Scatter {
  double seen = 0;    // relative standard deviation of the image's mean over seeds
  double stated = 0;  // root mean square of what each run says it is
};

Scatter scatter(const Tracer& tracer, const ReferenceParameters& parameters, int runs) {
  std::vector<double> means;
  double squares = 0;
  for (int i = 0; i < runs; ++i) {
    ReferenceParameters p = parameters;
    p.seed = 500 + i;
    const ReferenceResult r = compute_reference(tracer, p);
    double sum = 0;
    for (const glm::vec3& v : r.mean.pixels) sum += double(v.x) + v.y + v.z;
    means.push_back(sum);
    squares += r.standard_error * r.standard_error;
  }
  return {relative_standard_error(means) * std::sqrt(runs), std::sqrt(squares / runs)};
}

TEST(ReferenceNoise, OfTheImageMeanFallsWithTheRootOfTheSamplesAndIsStated) {
  const Scene scene = atrium();
  const Tracer tracer(scene);
  constexpr int runs = 24;
  ReferenceParameters p = tiny(128);
  p.strategies = strategy_light;
  const Scatter few = scatter(tracer, p, runs);
  p.samples *= 16;
  const Scatter many = scatter(tracer, p, runs);
  // Both are known to 15 %, their ratio to 21 %: 1/4, and three standard errors.
  EXPECT_LT(many.seen, few.seen / 4 * 1.63);
  for (const Scatter& s : {few, many}) EXPECT_NEAR(s.stated / s.seen, 1, 0.5);
}

TEST(ReferenceNoise, AFloorIsReachedAndTheBitsAreTheSame) {
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  ReferenceParameters p = tiny(16);
  const ReferenceResult plain = compute_reference(tracer, p);
  EXPECT_EQ(plain.ended_by, ReferenceEnd::samples);
  p.floor = plain.noise_floor_smape / 2;
  const ReferenceResult a = compute_reference(tracer, p);
  p.threads = 1;
  const ReferenceResult b = compute_reference(tracer, p);
  EXPECT_EQ(a.ended_by, ReferenceEnd::floor);
  EXPECT_LE(a.noise_floor_smape, p.floor);
  EXPECT_GT(a.samples, 2 * plain.samples);
  EXPECT_EQ(a.batches % 2, 0u);
  EXPECT_EQ(a.mean.pixels, b.mean.pixels);
  EXPECT_EQ(a.standard_error, b.standard_error);
}

TEST(ReferenceNoise, AFloorOutOfReachEndsInTime) {
  ReferenceParameters p = tiny(16);
  p.floor = 1e-6;
  p.time_limit = 0.05;
  const ReferenceResult r = compute_reference(test::slab_box(), p);
  EXPECT_EQ(r.ended_by, ReferenceEnd::time_limit);
  EXPECT_GT(r.noise_floor_smape, p.floor);
}

TEST(ReferenceNoise, StandardErrorOfFourNumbers) {
  const std::vector<double> values = {1, 2, 3, 6};  // mean 3, variance 14/3
  EXPECT_DOUBLE_EQ(relative_standard_error(values), std::sqrt(14.0 / 3 / 4) / 3);
  EXPECT_EQ(relative_standard_error(std::vector<double>{0, 0}), 0);
}

TEST(ReferenceNoise, PercentHasItsSign) {
  EXPECT_EQ(parse_percent("2%"), 2);
  EXPECT_EQ(parse_percent("0.5 %"), 0.5);
  for (const char* text : {"", "%", "2", "two%", "2%%", "nan%", "2 x%"})
    EXPECT_FALSE(parse_percent(text)) << text;
}

// Faces that are flat have one normal, and both conventions say the same.
TEST(ShadingNormals, OfFlatFacesMakeNoDifference) {
  const Scene scene = test::slab_box(test::mirror(30, {0.9f, 0.7f, 0.5f}));
  const Tracer tracer(scene);
  ReferenceParameters p = tiny(64);
  const ReferenceResult light = compute_reference(tracer, p);
  p.shading_normals = ShadingNormals::camera;
  const ReferenceResult camera = compute_reference(tracer, p);
  double largest = 0;
  for (size_t i = 0; i < light.mean.pixels.size(); ++i) {
    const float a = light.mean.pixels[i].y, b = camera.mean.pixels[i].y;
    if (a > 0) largest = std::max(largest, std::abs(double(b) / a - 1));
  }
  EXPECT_LT(largest, 1e-5);
}

}  // namespace
}  // namespace vsglbench
