#include "scene/shot.h"

#include <gtest/gtest.h>

#include <random>

#include "base/file.h"
#include "scene/found_view.h"
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
  EXPECT_FALSE(is_good(m));
}

// --- found views ---

class FoundViews : public ::testing::Test {
 protected:
  // By the definition: some of what is lit is seen, and indirect light reaches the view.
  static void expect_good(const Scene& scene, const FoundView& found) {
    const test::BruteShot b = test::brute_shot(scene, found.shot, 18);
    EXPECT_GT(b.lit_seen, 0.05);
    EXPECT_GT(b.reached, 0.3);
    EXPECT_GT(b.seen, 0.1);
  }
};

TEST_F(FoundViews, OfAnOpenRoom) {
  const Scene scene = test::built("cornell");
  const TriangleTree tree(scene);
  const auto found = find_view(tree);
  ASSERT_TRUE(found);
  EXPECT_TRUE(is_good(found->measure));
  expect_good(scene, *found);
}

// No camera outside sees any indirect light.
TEST_F(FoundViews, OfAClosedRoomAreInside) {
  const Scene scene = test::room_with({{{0, 0, 0}, {8, 3, 5}}, {{2, 0, 1}, {3, 1, 2}}});
  const TriangleTree tree(scene);
  const auto found = find_view(tree);
  ASSERT_TRUE(found);
  EXPECT_TRUE(is_good(found->measure));
  EXPECT_TRUE(found->inside);
  expect_good(scene, *found);
}

// A camera or a light that is given stays.
TEST_F(FoundViews, KeepWhatTheFileBrings) {
  const Scene scene = load_scene("cornell", {data_root() / "scenes", {}});
  const TriangleTree tree(scene);
  const auto lit = find_view(tree, {.fixed_camera = scene.camera});
  ASSERT_TRUE(lit);
  EXPECT_EQ(lit->shot.camera.position, scene.camera.position);
  expect_good(scene, *lit);
  const auto seen = find_view(tree, {.fixed_light = scene.light});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->shot.light.power, scene.light.power);
  expect_good(scene, *seen);
}

// A solid, as a tetrahedron is: light that leaves it never comes back.
TEST_F(FoundViews, OfAConvexObjectAreNone) {
  Scene scene;
  scene.name = "tetrahedron";
  scene.materials.emplace_back();
  Mesh mesh;
  const glm::dvec3 p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const glm::uvec3& t :
       {glm::uvec3(0, 2, 1), glm::uvec3(0, 1, 3), glm::uvec3(0, 3, 2), glm::uvec3(1, 2, 3)}) {
    const glm::vec3 n(glm::normalize(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x])));
    const uint32_t first = mesh.add_vertex(p[t.x], n, {0, 0});
    mesh.add_vertex(p[t.y], n, {1, 0});
    mesh.add_vertex(p[t.z], n, {0, 1});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  MeshCollector collector(&scene);
  collector.add(std::move(mesh), 0);
  collector.finish();
  const TriangleTree tree(scene);
  const auto found = find_view(tree);
  EXPECT_FALSE(found && is_good(found->measure));
}

}  // namespace
}  // namespace vsglbench
