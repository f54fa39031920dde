// The reference against closed forms and quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "reference/reference.h"
#include "reference/test_scenes.h"
#include "scene/view.h"

namespace vsglbench {
namespace {

ReferenceParameters small(uint32_t samples) {
  ReferenceParameters p;
  p.width = 64;
  p.height = 48;
  p.samples = samples;
  p.batches = 32;
  return p;
}

// A small patch lit by a spot above a large parallel floor: no occlusion, one receiver. The closed form is an
// integral over the patch alone, here by the midpoint rule in double.
TEST(ReferenceClosedForm, MatchesQuadratureOverALitPatch) {
  // The patch faces down at y = 1, lit from below through nothing; the floor at y = 0 is seen from above.
  const double half = 0.1;
  const glm::dvec3 rd_patch(0.8, 0.6, 0.4), rd_floor(0.5, 0.7, 0.9);
  Light light = test::spot({0.9f, 0.6f, 0.3f}, glm::vec3(0, 1, 0) - glm::vec3(0.9f, 0.6f, 0.3f), 0.6f);
  light.power = {10, 10, 10};
  const Scene scene = test::make_scene(
      {{{-half, 1, -half}, {2 * half, 0, 0}, {0, 0, 2 * half}, 0}, {{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 1}},
      {test::lambert(glm::vec3(rd_patch)), test::lambert(glm::vec3(rd_floor))}, light,
      test::camera_at({0, 0.9f, 3}, {0, 0, 0}, 0.35f));
  ReferenceParameters p = small(4096);
  const ReferenceResult r = compute_reference(scene, p);

  const glm::dvec3 apex(scene.light.position);
  const View camera = camera_view(scene.camera, p.width, p.height);
  const double floor_y = -scene.origin.y, patch_y = 1 - scene.origin.y;
  double z2 = 0, n = 0, sum = 0, want_sum = 0;
  for (uint32_t y = 0; y < p.height; ++y) {
    for (uint32_t x = 0; x < p.width; ++x) {
      glm::vec3 o, d;
      camera.ray({(x + 0.5f) / float(p.width), (y + 0.5f) / float(p.height)}, &o, &d);
      if (d.y >= 0 || !r.mask[y * p.width + x]) continue;
      const glm::dvec3 x2 = glm::dvec3(o) + glm::dvec3(d) * ((floor_y - o.y) / d.y);
      if (std::abs(x2.x) > 1.9 || std::abs(x2.z) > 1.9) continue;
      double integral = 0;
      constexpr int k = 24;
      for (int i = 0; i < k * k; ++i) {
        const glm::dvec3 x1(half * ((i % k + 0.5) * 2 / k - 1), patch_y, half * ((i / k + 0.5) * 2 / k - 1));
        const glm::dvec3 to_light = apex - x1, d12 = x2 - x1;
        const double e =
            10 * -to_light.y / std::pow(glm::length(to_light), 3);  // irradiance of the patch, I cos / d^2
        const double d2 = glm::dot(d12, d12), cosine = -d12.y / std::sqrt(d2);
        integral += e * cosine * cosine / d2 * (4 * half * half / (k * k));
      }
      const double want = integral * rd_patch.y * rd_floor.y / (std::numbers::pi * std::numbers::pi);
      const double got = r.mean.at(x, y).y, v = r.variance.at(x, y).y;
      z2 += (got - want) * (got - want) / v, n += 1;
      sum += got, want_sum += want;
    }
  }
  ASSERT_GT(n, 500);
  EXPECT_NEAR(sum / want_sum, 1, 3 * r.standard_error);  // pixels share x1, so the batches tell it
  EXPECT_LT(r.standard_error, 0.003) << "too noisy to show anything";
  EXPECT_NEAR(std::sqrt(z2 / n), 1, 0.25);
}

// A patch whose shading normals lean by 30 degrees, towards +x, under a spot: both conventions for x1 by the
// midpoint rule in double.
class TiltedNormals : public ::testing::TestWithParam<ShadingNormals> {};

TEST_P(TiltedNormals, FollowTheStatedConvention) {
  const double half = 0.1, tilt = std::numbers::pi / 6;
  const glm::dvec3 face(0, -1, 0), leaning(std::sin(tilt), -std::cos(tilt), 0);
  Scene scene = test::make_scene(
      {{{-half, 1, -half}, {2 * half, 0, 0}, {0, 0, 2 * half}, 0}, {{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 1}},
      {test::lambert(glm::vec3(0.8f)), test::lambert(glm::vec3(0.5f))},
      test::spot({0.9f, 0.4f, 0.3f}, glm::vec3(0, 1, 0) - glm::vec3(0.9f, 0.4f, 0.3f), 0.6f),
      test::camera_at({0.3f, 0.9f, 3}, {0.3f, 0, 0}, 0.3f));
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    if (scene.positions[i].y + scene.origin.y > 0.5) scene.normals[i] = glm::vec3(leaning);
  }
  ReferenceParameters p = small(512);
  p.shading_normals = GetParam();
  const ReferenceResult r = compute_reference(scene, p);

  const glm::dvec3 apex = glm::dvec3(scene.light.position) + scene.origin;
  const View camera = camera_view(scene.camera, p.width, p.height);
  double got = 0, want = 0;
  for (uint32_t i = 0; i < p.width * p.height; ++i) {
    glm::vec3 o, d;
    camera.ray((glm::vec2(i % p.width, i / p.width) + 0.5f) / glm::vec2(p.width, p.height), &o, &d);
    if (d.y >= 0) continue;
    const glm::dvec3 x2 = glm::dvec3(o) + glm::dvec3(d) * ((-scene.origin.y - o.y) / d.y) + scene.origin;
    if (std::abs(x2.x) > 1.9 || std::abs(x2.z) > 1.9) continue;
    constexpr int k = 24;
    for (int j = 0; j < k * k; ++j) {
      const glm::dvec3 x1(half * ((j % k + 0.5) * 2 / k - 1), 1, half * ((j / k + 0.5) * 2 / k - 1));
      const glm::dvec3 l = glm::normalize(apex - x1), v = glm::normalize(x2 - x1);
      const double light2 = glm::dot(apex - x1, apex - x1), d2 = glm::dot(x2 - x1, x2 - x1);
      if (glm::dot(leaning, l) <= 0 || glm::dot(leaning, v) <= 0) continue;
      const double at_x1 = GetParam() == ShadingNormals::light ? glm::dot(face, l) * glm::dot(leaning, v)
                                                               : glm::dot(leaning, l) * glm::dot(face, v);
      want += at_x1 * -v.y / (light2 * d2) * 0.8 * 0.5 / std::pow(std::numbers::pi, 2) * 4 * half * half /
              (k * k);
    }
    got += r.mean.pixels[i].y;
  }
  ASSERT_GT(want, 0);
  EXPECT_NEAR(got / want, 1, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Conventions, TiltedNormals,
                         ::testing::Values(ShadingNormals::light, ShadingNormals::camera),
                         [](const auto& p) { return std::string(name(p.param)); });

// The mean and root-mean-square deviation of green from `want(x2, eye ray)`, over the pixels of a horizontal
// floor where it has a value, must be small.
using Want = std::function<std::optional<double>(const glm::dvec3&, const glm::dvec3&)>;
void expect_floor(const Scene& scene, const ReferenceParameters& p, const ReferenceResult& r, double floor_y,
                  double tolerance, const Want& want) {
  const View camera = camera_view(scene.camera, p.width, p.height);
  double sum = 0, want_sum = 0, squares = 0, n = 0;
  for (uint32_t i = 0; i < p.width * p.height; ++i) {
    glm::vec3 o, d;
    camera.ray((glm::vec2(i % p.width, i / p.width) + 0.5f) / glm::vec2(p.width, p.height), &o, &d);
    if (d.y >= 0) continue;
    const glm::dvec3 x2 = glm::dvec3(o) + glm::dvec3(d) * ((floor_y - scene.origin.y - o.y) / d.y);
    const std::optional<double> value = want(x2 + scene.origin, glm::dvec3(d));
    if (!value) continue;
    sum += r.mean.pixels[i].y, want_sum += *value, n += 1;
    squares += std::pow(r.mean.pixels[i].y / *value - 1, 2);
  }
  ASSERT_GT(n, 50);
  EXPECT_NEAR(sum / want_sum, 1, tolerance);
  EXPECT_LT(std::sqrt(squares / n), 5 * tolerance);
}

// Near-mirror emitter: a Phong 65535 wall at x = 1 throws the spot onto the floor as if from its mirror
// image.
TEST(ReferenceClosedForm, MirrorThrowsACaustic) {
  const glm::vec3 apex(0, 1, 0), axis(1, -0.6f, 0);
  const Scene scene =
      test::make_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0}, {{1, 0, -1}, {0, 0, 2}, {0, 2, 0}, 1}},
                       {test::lambert({0.5f, 0.5f, 0.5f}), test::mirror(65535, {1, 1, 1})},
                       test::spot(apex, axis, 0.3f, {0, 1, 0}),
                       test::camera_at({0.3f, 2, 0.01f}, {0.3f, 0, 0}, 0.3f, {0, 0, -1}));
  ReferenceParameters p = small(256);
  p.photons_a_sample = 4;
  const ReferenceResult r = compute_reference(scene, p);
  const View image =
      light_view(test::spot({2, 1, 0}, {-1, -0.6f, 0}, 0.27f, {0, 1, 0}));  // inside the blurred rim
  expect_floor(scene, p, r, 0, 0.01, [&](const glm::dvec3& x2, const glm::dvec3&) -> std::optional<double> {
    if (!image.project(glm::vec3(x2))) return std::nullopt;
    const glm::dvec3 d = glm::dvec3(2, 1, 0) - x2;
    return 0.5 / std::numbers::pi * d.y / std::pow(glm::length(d), 3);
  });
}

// Near-mirror receiver: a Phong 65535 floor shows the lit wall.
TEST(ReferenceClosedForm, MirrorShowsALitWall) {
  const glm::vec3 apex(-0.5f, 1, 0);
  const Scene scene = test::make_scene(
      {{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0}, {{1, 0, -1}, {0, 0, 2}, {0, 2, 0}, 1}},
      {test::mirror(65535, {1, 1, 1}), test::lambert({0.5f, 0.5f, 0.5f})},
      test::spot(apex, {1, 0, 0}, 0.6f, {0, 1, 0}), test::camera_at({-0.8f, 0.8f, 0}, {0.3f, 0, 0}, 0.5f));
  const ReferenceParameters p = small(256);
  const ReferenceResult r = compute_reference(scene, p);
  const View inner = light_view(test::spot(apex, {1, 0, 0}, 0.55f, {0, 1, 0}));
  expect_floor(scene, p, r, 0, 0.01, [&](const glm::dvec3& x2, const glm::dvec3& d) -> std::optional<double> {
    if (std::abs(x2.x) > 1 || std::abs(x2.z) > 1) return std::nullopt;
    const glm::dvec3 mirrored(d.x, -d.y, d.z), x1 = x2 + mirrored * ((1 - x2.x) / mirrored.x);
    if (!inner.project(glm::vec3(x1))) return std::nullopt;
    const glm::dvec3 to_light = glm::dvec3(apex) - x1;
    return 0.5 / std::numbers::pi * -to_light.x / std::pow(glm::length(to_light), 3);
  });
}

}  // namespace
}  // namespace vsglbench
