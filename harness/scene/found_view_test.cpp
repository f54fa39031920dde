#include "scene/found_view.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "scene/gltf_fixture.h"
#include "scene/scene_file.h"
#include "scene/view_fixture.h"

namespace vsglbench {
namespace {

// By the definition: some of what is lit is seen, and indirect light reaches the view.
void expect_good(const Scene& scene, const Shot& shot, const std::string& name) {
  const test::BruteShot b = test::brute_shot(scene, shot, 14);
  EXPECT_GT(b.lit_seen, 0.05) << name;
  EXPECT_GT(b.reached, 0.3) << name;
  EXPECT_GT(b.seen, 0.1) << name;
  EXPECT_GT(b.direct, 0.05) << name;
  EXPECT_LT(b.direct, 0.95) << name;
}

TEST(FoundViews, OfAnOpenRoom) {
  const Scene scene = test::built("cornell");
  const TriangleTree tree(scene);
  const auto found = find_view(tree);
  ASSERT_TRUE(found);
  EXPECT_TRUE(is_good(found->measure));
  expect_good(scene, found->shot, "cornell");
}

// Within it, and not with the nose to a wall.
TEST(FoundViews, OfPlacesAreInside) {
  for (const test::Model& model : test::models()) {
    if (!model.place) continue;
    const Scene scene = test::scene_of(model.mesh);
    const TriangleTree tree(scene);
    const auto found = find_view(tree);
    ASSERT_TRUE(found) << model.name;
    EXPECT_TRUE(is_good(found->measure)) << model.name;
    EXPECT_TRUE(found->inside) << model.name;
    expect_good(scene, found->shot, model.name);
    const auto seen = points_seen(tree, view_of(found->shot.camera), 16, 9);
    const auto near =
        std::ranges::count_if(seen, [](const ShotPoint& p) { return p.distance < 0.5f; });  // metres
    EXPECT_LT(near, 15) << model.name;
  }
}

// A camera or a light that is given stays.
TEST(FoundViews, KeepWhatTheFileBrings) {
  const Scene scene = load_scene("cornell", {data_root() / "scenes", {}});
  const TriangleTree tree(scene);
  const auto lit = find_view(tree, {.fixed_camera = scene.camera});
  ASSERT_TRUE(lit);
  EXPECT_EQ(lit->shot.camera.position, scene.camera.position);
  expect_good(scene, lit->shot, "cornell's camera");
  const auto seen = find_view(tree, {.fixed_light = scene.light});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->shot.light.power, scene.light.power);
  expect_good(scene, seen->shot, "cornell's light");
}

// A solid, as a box is: light that leaves it never comes back.
TEST(FoundViews, OfAConvexObjectAreNone) {
  const Scene scene = test::room_with({{{0, 0, 0}, {1, 1, 1}}});
  Scene box = scene;
  for (glm::uvec3& t : box.triangles) std::swap(t.y, t.z);
  const TriangleTree tree(box);
  const auto found = find_view(tree);
  EXPECT_FALSE(found && is_good(found->measure));
}

// A shot that is good but for one thing.
TEST(FoundViews, AreGoodInAllThatIsWanted) {
  const ShotMeasure good{.seen = 0.9,
                         .subject = 0.3,
                         .lit = 1,
                         .lit_seen = 0.5,
                         .direct = 0.4,
                         .subject_direct = 0.4,
                         .reached = 0.9,
                         .strength = 0.3,
                         .nearest = 1,
                         .depth = 1};
  EXPECT_TRUE(is_good(good));
  for (double ShotMeasure::*part : {&ShotMeasure::seen, &ShotMeasure::lit_seen, &ShotMeasure::subject_direct,
                                    &ShotMeasure::reached, &ShotMeasure::strength}) {
    ShotMeasure poor = good;
    poor.*part = 0;
    EXPECT_FALSE(is_good(poor));
  }
  ShotMeasure dim = good;
  dim.strength = 0.02;
  EXPECT_TRUE(is_good(dim));
  EXPECT_FALSE(is_good(dim, kWantedOfLoneObject));
}

// --- as a file by itself is loaded, with scenery where it needs some ---

class FoundModels : public GltfFixture {
 protected:
  // The model `scale` times as large, moved by a node, so that its vertices keep their digits.
  Scene load_model(const Mesh& mesh, double scale = 1, const glm::dvec3& at = glm::dvec3(0)) {
    json_["bufferViews"] = json_["accessors"] = Json::array();
    bin_.clear();
    std::vector<float> positions;
    for (const glm::dvec3& p : mesh.positions)
      for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(scale * p[k]));
    std::vector<uint32_t> indices;
    for (const glm::uvec3& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    primitive()["attributes"]["POSITION"] = add_floats(positions, "VEC3", 3);
    primitive()["indices"] = add<uint32_t>(indices, 5125, "SCALAR", 1);
    json_["nodes"][0]["translation"] = {at.x, at.y, at.z};
    return load_scene(write_gltf(), {});
  }

  // An object is whole in the picture and large in it, lit, and not everywhere.
  static void expect_shown(const Scene& scene, size_t triangles, const std::string& name) {
    EXPECT_GT(test::margin(scene, triangles), 0.02) << name;
    const View camera = view_of(scene.camera), lamp = light_view(scene.light);
    const auto seen = test::brute_points(scene, camera, 49, 27);
    size_t subject = 0, lit = 0, subject_lit = 0;
    for (const test::BruteHit& p : seen) {
      const bool on =
          p.triangle<triangles, sunny = glm::dot(glm::dvec3(lamp.position) - p.point, p.normal)> 0 &&
          test::brute_sees(scene, lamp, p.point);
      subject += on;
      lit += sunny;
      subject_lit += on && sunny;
    }
    EXPECT_GT(static_cast<double>(subject), (name == "pole" ? 0.004 : 0.07) * 49 * 27) << name;
    EXPECT_GT(static_cast<double>(subject_lit), 0.05 * static_cast<double>(subject)) << name;
    EXPECT_GT(static_cast<double>(lit), 0.05 * static_cast<double>(seen.size())) << name;
    EXPECT_LT(static_cast<double>(lit), 0.95 * static_cast<double>(seen.size())) << name;
    for (const std::string& w : scene.warnings) EXPECT_EQ(w.find("poor"), std::string::npos) << name;
  }
};

TEST_F(FoundModels, ObjectsAreSeenWholeAndLit) {
  for (const test::Model& model : test::models()) {
    if (model.place) continue;
    const Scene scene = load_model(model.mesh);
    expect_shown(scene, model.mesh.triangles.size(), model.name);
    expect_good(scene, {scene.camera, scene.light}, model.name);
  }
}

// The same picture of a model of any size, anywhere.
TEST_F(FoundModels, SizeAndPlaceChangeNothing) {
  const std::vector<test::Model> models = test::models();
  const auto cup = std::ranges::find(models, "cup", &test::Model::name);
  ASSERT_NE(cup, models.end());
  const Scene plain = load_model(cup->mesh);
  const auto look = [](const Scene& s) {
    return std::pair(s.camera.direction, (s.camera.position - glm::vec3(0)) / s.diagonal());
  };
  const struct {
    double scale;
    glm::dvec3 at;
  } kinds[] = {{0.0005, {0, 0, 0}}, {5000, {0, 0, 0}}, {1, {3000, -200, 70000}}, {0.0005, {30, 2, -40}}};
  for (const auto& [scale, at] : kinds) {
    const Scene scene = load_model(cup->mesh, scale, at);
    const std::string name = fmt::format("cup × {} at {}", scale, at.x);
    expect_shown(scene, cup->mesh.triangles.size(), name);
    EXPECT_LT(glm::length(look(scene).first - look(plain).first), 0.01f) << name;
    EXPECT_LT(glm::length(look(scene).second - look(plain).second), 0.01f) << name;
  }
}

}  // namespace
}  // namespace vsglbench
