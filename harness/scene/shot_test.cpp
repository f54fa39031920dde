#include "scene/shot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/file.h"
#include "scene/scene_file.h"
#include "scene/shot_fixture.h"

namespace vsglbench {
namespace {

// A cloud of random triangles, slivers and far ones among them; the oracle tries them all.
TEST(TriangleTree, MeetsWhatAllTrianglesGive) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto point = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  Scene scene;
  for (uint32_t i = 0; i < 300; ++i) {
    const glm::vec3 at = 3.0f * point();
    const float size = i % 7 == 0 ? 4.0f : 0.4f;
    for (int k = 0; k < 3; ++k) scene.positions.push_back(at + size * point());
    if (i % 11 == 0) scene.positions.back() = scene.positions[scene.positions.size() - 2] + 1e-3f * point();
    scene.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  scene.bounds_min = glm::vec3(-7);
  scene.bounds_max = glm::vec3(7);
  const TriangleTree tree(scene);
  size_t hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 origin = 5.0f * point(), direction = glm::normalize(point());
    const auto hit = tree.intersect(origin, direction);
    const auto want = test::brute_hit(scene, origin, direction);
    ASSERT_EQ(hit.has_value(), want.has_value()) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->distance, want->distance, 1e-5 * (1 + want->distance)) << i;
    const glm::vec3 beyond = origin + 2 * hit->distance * direction,
                    before = origin + 0.5f * hit->distance * direction;
    if (hit->distance < 0.01f) continue;  // too near an end of the segment to count
    EXPECT_TRUE(tree.occluded(origin, beyond)) << i;
    EXPECT_FALSE(tree.occluded(origin, before)) << i;
  }
  EXPECT_GT(hits, 500u);
}

TEST(Shot, SharesAreThoseOfTheDefinition) {
  const Scene scene = load_scene("cornell", {data_root() / "scenes", {}});
  const TriangleTree tree(scene);
  Shot shot{scene.camera, scene.light};
  for (const float turn : {0.0f, 0.5f}) {
    shot.camera.direction = glm::normalize(glm::vec3(turn, -0.1f * turn, -1));
    shot.camera.up = glm::normalize(glm::vec3(0, 1, 0) - shot.camera.direction.y * shot.camera.direction);
    const ShotMeasure m = measure_shot(tree, shot, {.image = 18, .light = 18, .links = 18});
    const test::BruteShot want = test::brute_shot(scene, shot, 27);
    EXPECT_NEAR(m.seen, want.seen, 0.03);
    EXPECT_NEAR(m.lit_seen, want.lit_seen, 0.04);
    EXPECT_NEAR(m.direct, want.direct, 0.05);
    EXPECT_NEAR(m.reached, want.reached, 0.05);
  }
}

TEST(Shot, ALampThatLightsNothingOrACameraThatSeesNothingIsSaid) {
  const Scene scene = load_scene("cornell", {data_root() / "scenes", {}});
  const TriangleTree tree(scene);
  Shot away{scene.camera, scene.light};
  away.camera.direction = {0, 0, 1};
  EXPECT_EQ(measure_shot(tree, away).seen, 0);
  Shot dark{scene.camera, scene.light};
  dark.light.position = {0, 0, 50};
  dark.light.direction = {0, 0, 1};
  dark.light.up = {0, 1, 0};
  const ShotMeasure m = measure_shot(tree, dark);
  EXPECT_EQ(m.lit, 0);
  EXPECT_EQ(m.reached, 0);
}

// The slab covers the right half of the floor, and the lamp shines on its edge.
TEST(Shot, TellsHowMuchOfTheSubjectIsLit) {
  const Scene scene = test::room_with({{{-4, -1, -4}, {4, 4, 4}}, {{0, -1, -4}, {4, -0.9, 4}}});
  Scene turned = scene;  // the slab first
  std::ranges::rotate(turned.triangles, turned.triangles.begin() + 12);
  const TriangleTree tree(turned);
  Shot shot;
  shot.camera = {.position = {0, 2, 3}, .direction = {0, -0.8f, -0.6f}, .up = {0, 0.6f, -0.8f}, .vfov = 1.2f};
  shot.light = {.position = {0, 1, 0}, .direction = {0, -1, 0}, .up = {0, 0, 1}, .fov = 0.5f};
  const ShotMeasure m = measure_shot(tree, shot, {.subject_triangles = 12});
  shot.light.fov = 3;
  const ShotMeasure wide = measure_shot(tree, shot, {.subject_triangles = 12});
  EXPECT_GT(m.subject, 0.1);
  EXPECT_GT(wide.subject_direct, 0.9);
  EXPECT_LT(m.subject_direct, 0.5);
  EXPECT_GT(m.subject_direct, 0.02);
  // A lamp that misses it.
  shot.light.fov = 0.5f;
  shot.light.position.x = -2;
  EXPECT_EQ(measure_shot(tree, shot, {.subject_triangles = 12}).subject_direct, 0);
}

}  // namespace
}  // namespace vsglbench
