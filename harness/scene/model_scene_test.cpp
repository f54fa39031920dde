#include "scene/model_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error_list.h"
#include "base/file.h"
#include "scene/gltf_fixture.h"
#include "scene/scene_file.h"
#include "scene/shot_fixture.h"

namespace vsglbench {
namespace {

bool any_of(const std::vector<std::string>& lines, const std::string& part) {
  return std::ranges::any_of(lines, [&](const std::string& l) { return l.find(part) != std::string::npos; });
}

class Models : public GltfFixture {
 protected:
  // A room of 4 × 4 m, open to the front, 3 m high: floor, back wall and both side walls.
  void add_room() {
    primitive()["attributes"]["POSITION"] = add_floats(
        {-2, 0, -2, 2, 0, -2, 2, 0, 2, -2, 0, 2, -2, 3, -2, 2, 3, -2, 2, 3, 2, -2, 3, 2}, "VEC3", 3);
    primitive()["indices"] = add<uint16_t>(
        {0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5}, 5123, "SCALAR", 1);
    primitive()["material"] = 0;
    json_["materials"] = {{{"name", "plaster"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  }
  // A tetrahedron, convex.
  void add_solid() {
    primitive()["attributes"]["POSITION"] = add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
    primitive()["indices"] = add<uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, 5123, "SCALAR", 1);
  }
  // A node that turns what looks along -z by `degrees` about x, at a place.
  Json node(const glm::dvec3& at, double degrees) const {
    const double half = degrees * std::numbers::pi / 360;
    return {{"translation", {at.x, at.y, at.z}}, {"rotation", {std::sin(half), 0, 0, std::cos(half)}}};
  }
  void add_node(Json n) {
    json_["nodes"].push_back(std::move(n));
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
  }
  void add_camera() {
    json_["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    Json n = node({0.1, 1.5, 5}, -5);
    n["camera"] = 0;
    n["name"] = "shot 1";
    add_node(n);
  }
  void add_light(Json light, const glm::dvec3& at, double degrees) {
    json_["extensionsUsed"] = {"KHR_lights_punctual"};
    json_["extensions"]["KHR_lights_punctual"]["lights"].push_back(std::move(light));
    Json n = node(at, degrees);
    n["extensions"]["KHR_lights_punctual"]["light"] =
        json_["extensions"]["KHR_lights_punctual"]["lights"].size() - 1;
    add_node(n);
  }
  Scene load_model() { return load_scene(write_gltf(), {}); }

  // What the camera sees of the lit surface, and the share of its picture that indirect light reaches, by
  // the definition.
  static void expect_lit(const Scene& scene) {
    const test::BruteShot b = test::brute_shot(scene, {scene.camera, scene.light}, 18);
    EXPECT_GT(b.lit_seen, 0.05);
    EXPECT_GT(b.reached, 0.3);
  }
};

TEST_F(Models, ItsOwnCameraAndSpotAreTaken) {
  add_room();
  add_camera();
  add_light(
      {{"type", "spot"}, {"intensity", 683}, {"color", {1, 0.5, 0.25}}, {"spot", {{"outerConeAngle", 0.5}}}},
      {0.3, 2.5, 1}, -70);
  const Scene scene = load_model();
  EXPECT_EQ(scene.name, "scene");
  const glm::dvec3 eye = glm::dvec3(scene.camera.position) + scene.origin;
  EXPECT_NEAR(eye.z, 5, 1e-5);
  EXPECT_NEAR(scene.camera.vfov, 0.8, 1e-6);
  EXPECT_NEAR(scene.camera.direction.y, -std::sin(5 * std::numbers::pi / 180), 1e-5);
  EXPECT_EQ(scene.light.type, Light::Type::spot);
  EXPECT_NEAR(scene.light.fov, 1, 1e-6);  // the square round the cone
  EXPECT_NEAR(scene.light.power.x, 1, 1e-6);
  EXPECT_NEAR(scene.light.power.y, 0.5, 1e-6);
  EXPECT_NEAR(scene.light.direction.y, -std::sin(70 * std::numbers::pi / 180), 1e-5);
  EXPECT_NEAR(scene.light.up.y, std::cos(70 * std::numbers::pi / 180), 1e-5);
  EXPECT_EQ(scene.triangles.size(), 8u);
}

TEST_F(Models, ADirectionalLightIsASun) {
  add_room();
  add_camera();
  add_light({{"type", "directional"}, {"intensity", 6830}}, {0, 0, 0}, -60);
  const Scene scene = load_model();
  EXPECT_EQ(scene.light.type, Light::Type::directional);
  EXPECT_NEAR(scene.light.power.z, 10, 1e-5);
  EXPECT_NEAR(scene.light.direction.y, -std::sin(std::numbers::pi / 3), 1e-5);
}

TEST_F(Models, APointLightIsAConeTowardsTheViewAndSaysSo) {
  add_room();
  add_camera();
  add_light({{"type", "point"}, {"intensity", 100}, {"name", "bulb"}}, {0, 2.5, 1}, 0);
  const Scene scene = load_model();
  EXPECT_EQ(scene.light.type, Light::Type::spot);
  EXPECT_NEAR(scene.light.fov, 120 * std::numbers::pi / 180, 1e-5);
  EXPECT_LT(scene.light.direction.z, -0.2f);  // towards the back wall that the camera sees
  EXPECT_TRUE(any_of(scene.warnings, "point light 'bulb' is read as a spot of 120 degrees"));
}

TEST_F(Models, WithoutAViewOneIsFound) {
  add_room();
  const Scene scene = load_model();
  EXPECT_TRUE(any_of(scene.warnings, "a view and a spot were found"));
  EXPECT_EQ(scene.triangles.size(), 8u);
  expect_lit(scene);
}

TEST_F(Models, WithACameraAloneASpotIsFoundAndTheOtherWayRound) {
  add_room();
  add_camera();
  const Scene lit = load_model();
  EXPECT_TRUE(any_of(lit.warnings, "the file has no light: a spot was found for its camera 'shot 1'"));
  EXPECT_NEAR(lit.camera.vfov, 0.8, 1e-6);
  expect_lit(lit);
}

// A camera that looks away is no default view.
TEST_F(Models, AViewThatSeesNothingIsSaidAndAnotherIsFound) {
  add_room();
  add_camera();
  json_["nodes"][1]["rotation"] = {0, 1, 0, 0};
  add_light({{"type", "spot"}, {"intensity", 683}, {"spot", {{"outerConeAngle", 0.6}}}}, {0.3, 2.5, 1}, -70);
  const Scene scene = load_model();
  EXPECT_TRUE(any_of(scene.warnings, "camera 'shot 1' sees no indirect light"));
  expect_lit(scene);
}

TEST_F(Models, AConvexObjectGetsAFloorAndTwoWalls) {
  add_solid();
  const Scene scene = load_model();
  EXPECT_EQ(scene.triangles.size(), 4u + 6);
  EXPECT_TRUE(any_of(scene.warnings, "a floor and two walls were added"));
  expect_lit(scene);
  // All stand on the floor, before the walls.
  for (size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_GT(scene.positions[scene.triangles[i][k]][axis], scene.bounds_min[axis]);
}

// new-scene writes what --scene takes: the same view, light and geometry, to the bit.
TEST_F(Models, ItsSceneFileIsTheSameScene) {
  for (const bool solid : {false, true}) {
    json_["meshes"][0]["primitives"][0] = {{"attributes", Json::object()}};
    solid ? add_solid() : add_room();
    const std::string path = write_gltf();
    Scene geometry;
    load_gltf(path, 1, &geometry);
    std::filesystem::create_directories(folder_ / "made");
    write("made/scene.json", model_scene(path, geometry, "../scene.gltf").json.dump(2));
    const Scene by_itself = load_scene(path, {}), by_file = load_scene((folder_ / "made").string(), {});
    EXPECT_EQ(by_file.hash, by_itself.hash);
    EXPECT_EQ(by_file.triangles.size(), by_itself.triangles.size());
  }
}

TEST_F(Models, AChangedFileIsSaid) {
  add_room();
  const std::string path = write_gltf();
  Scene geometry;
  load_gltf(path, 1, &geometry);
  Json scene = model_scene(path, geometry, "scene.gltf").json;
  EXPECT_EQ(scene["about"]["triangles"], 8);
  EXPECT_EQ(scene["about"]["materials"][0]["name"], "plaster");
  scene["about"]["triangles"] = 9;
  write("scene.json", scene.dump());
  EXPECT_TRUE(
      any_of(load_scene((folder_ / "scene.json").string(), {}).warnings, "has 8 triangles, and had 9"));
}

// One line each, all of them at once.
TEST_F(Models, AllFaultsOfASceneFileAreToldAtOnce) {
  add_room();
  const std::string path = write_gltf();
  Scene geometry;
  load_gltf(path, 1, &geometry);
  Json scene = model_scene(path, geometry, "scene.gltf").json;
  scene["views"]["found"]["camera"]["vfof"] = 3;
  scene["views"]["found"]["light"]["spot"]["target"] = scene["views"]["found"]["light"]["spot"]["position"];
  scene["views"]["other"] = scene["views"]["found"];
  scene["views"]["other"]["camera"] = {{"eye", {0, 0, 0}}, {"direction", {0, 0, 0}}, {"vfov", 40}};
  scene["materials"] = {{{"match", "wood"}}};
  scene["default_view"] = "fuond";
  scene["unit"] = 0;
  write("scene.json", scene.dump(1));
  try {
    load_scene((folder_ / "scene.json").string(), {});
    FAIL();
  } catch (const ErrorList& e) {
    for (const char* part :
         {"unknown key 'vfof'", "'unit'", "'views/found/light/spot/target' is where it looks from",
          "'views/other/camera/direction' has no length", "'wood' matches no material",
          "has no view 'fuond'; did you mean 'found'?"})
      EXPECT_TRUE(any_of(e.lines(), part)) << part << " in " << e.what();
    EXPECT_EQ(e.lines().size(), 7u) << e.what();  // the lamp's target is that of two views
    for (const std::string& line : e.lines()) EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST(ModelNames, AreThoseOfGltfFiles) {
  EXPECT_TRUE(is_model("a/b.GLB"));
  EXPECT_TRUE(is_model("b.gltf"));
  EXPECT_FALSE(is_model("scene.json"));
  EXPECT_EQ(model_name("/x/my model:2.glb"), "my_model_2");
  EXPECT_EQ(model_name(".glb"), "_glb");
}

}  // namespace
}  // namespace vsglbench
