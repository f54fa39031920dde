#include "scene/subject.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "scene/scene_file.h"
#include "scene/view_fixture.h"

namespace vsglbench {
namespace {

TEST(Subject, OneIsWithinAPlaceAndBeforeAnObject) {
  for (const test::Model& model : test::models()) {
    const Scene scene = test::scene_of(model.mesh);
    const TriangleTree tree(scene);
    EXPECT_EQ(Subject(tree, ~0u).is_place(), model.place) << model.name;
  }
}

// From wherever one looks: all of it in the frame, and no more room about it than is asked for.
TEST(Subject, StandsWholeInTheFrame) {
  for (const test::Model& model : test::models()) {
    Scene scene = test::scene_of(model.mesh);
    const TriangleTree tree(scene);
    const Subject subject(tree, ~0u);
    for (const float azimuth : {0.0f, 70.0f, 200.0f}) {
      for (const float elevation : {-10.0f, 5.0f, 40.0f, 85.0f}) {
        scene.camera.direction = -direction_of(azimuth, elevation);
        scene.camera.up = up_for(scene.camera.direction);
        scene.camera.vfov = 0.7f;
        scene.camera.position = subject.eye_before(scene.camera.direction, 0.7f, 16.0f / 9);
        const double margin = test::margin(scene, scene.triangles.size());
        EXPECT_GT(margin, 0.04) << model.name << " from " << azimuth << ", " << elevation;
        EXPECT_LT(margin, 0.3) << model.name << " from " << azimuth << ", " << elevation;
      }
    }
  }
}

// Scenery behind what the pictures are of does not count.
TEST(Subject, IsTheFirstTriangles) {
  const Scene scene = test::room_with({{{0, 0, 0}, {9, 9, 9}}, {{4, 4, 4}, {5, 5, 5}}});
  const TriangleTree tree(scene);
  const Subject all(tree, ~0u), room(tree, 12);
  EXPECT_NEAR(glm::length(all.centre() - room.centre()), 0, 1e-6);
  EXPECT_TRUE(room.contains(scene.bounds_max - glm::vec3(0.1f)));
  EXPECT_NEAR(room.radius(), std::sqrt(3.0) * 4.5, 1e-4);
}

}  // namespace
}  // namespace vsglbench
