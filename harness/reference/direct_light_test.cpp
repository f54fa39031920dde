#include "reference/direct_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/test_scenes.h"
#include "scene/view.h"

namespace vsglbench {
namespace {

// A floor under a spot, with a plate between them that shadows half of it. The oracle is the definition: ρ/π
// times I cos / d², where the straight line to the lamp passes beside the plate.
TEST(DirectLight, IsTheDefinitionWithExactShadows) {
  Light light = test::spot({0.2f, 3, 0.1f}, {0, -1, 0}, 1.2f);
  light.power = {10, 5, 2};
  const Scene scene = test::make_scene(
      {{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0}, {{0, 1, 2}, {2, 0, 0}, {0, 0, -4}, 0}},
      {test::lambert({0.5f, 0.6f, 0.7f})}, light, test::camera_at({0, 0.6f, 3}, {-0.3f, 0, 0}, 0.6f));
  const Tracer tracer(scene);
  constexpr uint32_t kWidth = 48, kHeight = 36;
  const DirectLight direct = direct_light(tracer, kWidth, kHeight);
  const View camera = camera_view(scene.camera, kWidth, kHeight);
  const double floor_y = -scene.origin.y;
  size_t lit = 0, shadowed = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      glm::vec3 o, d;
      camera.ray((glm::vec2(x, y) + 0.5f) / glm::vec2(kWidth, kHeight), &o, &d);
      const glm::dvec3 p = glm::dvec3(o) + glm::dvec3(d) * ((floor_y - o.y) / d.y);
      if (!(d.y < 0) || std::abs(p.x + scene.origin.x) > 1.99 || std::abs(p.z + scene.origin.z) > 1.99)
        continue;
      if (p.y + scene.origin.y > 0.5) continue;
      const glm::dvec3 way = glm::dvec3(scene.light.position) - p;
      const double across = p.x + scene.origin.x + way.x / 3;  // where the line passes the plate's height
      if (std::abs(across) < 0.02) continue;                   // too near its edge to tell
      const double cosine = way.y / glm::length(way), t = std::tan(0.6);
      if (std::abs(std::abs(way.x / way.y) - t) < 0.02 || std::abs(std::abs(way.z / way.y) - t) < 0.02)
        continue;
      const bool in_beam = std::abs(way.x / way.y) < t && std::abs(way.z / way.y) < t;
      const bool free = in_beam && across < 0;
      const double want = free ? 0.5 / std::numbers::pi * 10 * cosine / glm::dot(way, way) : 0;
      EXPECT_NEAR(direct.image.at(x, y).x, want, 1e-4 * std::max(want, 1e-3)) << x << " " << y;
      (free ? lit : shadowed) += 1;
    }
  }
  EXPECT_GT(lit, 100u);
  EXPECT_GT(shadowed, 100u);
}

}  // namespace
}  // namespace vsglbench
