#include "scene/scene_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

#include "scene/gltf_fixture.h"
#include "scene/scene_view.h"
#include "scene/view.h"

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

SceneOptions shipped() {
  const char* assets = std::getenv("VSGLBENCH_ASSETS");
  return {fs::path(VSGLBENCH_SOURCE_DIR) / "scenes", assets ? assets : ""};
}

// A scene.json of ten lines beside a square in "scene.gltf".
constexpr const char* kText = R"({
  "name": "test", "description": "a square",
  "geometry": {"file": "scene.gltf"},
  "unit": 0.01,
  "materials": [{"match": "(def*", "base_color": [0.1, 0.2, 0.3], "roughness": 0.4, "phong_exponent": 50}],
  "views": {"A": {
    "camera": {"eye": [0, 0, 400], "target": [50, 0, 0], "vfov": 45},
    "light": {"spot": {"position": [100, 0, 300], "direction": [0, 0, -2], "fov": 60, "intensity": [40000, 0, 0]}}}},
  "default_view": "A"
})";

class SceneFile : public GltfFixture {
 protected:
  void SetUp() override {
    GltfFixture::SetUp();
    add_square();
    write_gltf();
  }
  std::string path() const { return (folder_ / "scene.json").string(); }
  Scene load_text(const std::string& text, const std::string& view = "") {
    write("scene.json", text);
    return load_scene(path() + view, {});
  }
  // The error after replacing `from` by `to` in kText.
  std::string error_of(const std::string& from, const std::string& to) {
    std::string text = kText;
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
      load_text(text);
      return "";
    } catch (const Error& e) {
      return e.what();
    }
  }
};

TEST_F(SceneFile, LengthsAreScaledAndRebased) {
  const Scene scene = load_text(kText);
  EXPECT_EQ(scene.name, "test");
  EXPECT_NEAR(scene.bounds_max.x, 0.005, 1e-8);
  const glm::dvec3 eye = glm::dvec3(scene.camera.position) + scene.origin;
  EXPECT_NEAR(eye.z, 4, 1e-6);
  EXPECT_NEAR(scene.camera.vfov, std::acos(-1.0) / 4, 1e-6);
  EXPECT_NEAR(scene.camera.direction.x, 50 / std::hypot(50, 400), 1e-6);
  EXPECT_NEAR(scene.light.direction.z, -1, 1e-6);
  EXPECT_NEAR(scene.light.fov, std::acos(-1.0) / 3, 1e-6);
  // I/d^2 in file units, at 100 units = 1 m: 4 W/m^2; so 4 W/sr.
  EXPECT_NEAR(scene.light.power.x, 4, 1e-5);
  EXPECT_EQ(scene.light.power.y, 0);
}

TEST_F(SceneFile, OverridesReplaceFactors) {
  const Material m = load_text(kText).materials[0];
  EXPECT_FLOAT_EQ(m.base_color.y, 0.2f);
  EXPECT_FLOAT_EQ(m.roughness, 0.4f);
  EXPECT_FLOAT_EQ(m.phong_exponent, 50);
  EXPECT_FLOAT_EQ(m.metallic, 1);  // glTF's default, untouched
}

TEST_F(SceneFile, HashFollowsWhatDeterminesRadiance) {
  const std::string hash = load_text(kText).hash;
  EXPECT_EQ(load_text(kText).hash, hash);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"roughness\": 0.4", "\"roughness\": 0.41"},
                                                        {"[0, 0, 400]", "[0, 0, 401]"},
                                                        {"\"fov\": 60", "\"fov\": 61"},
                                                        {"40000", "40001"},
                                                        {"\"unit\": 0.01", "\"unit\": 0.02"}}) {
    std::string text = kText;
    text.replace(text.find(from), from.size(), to);
    EXPECT_NE(load_text(text).hash, hash) << from;
  }
  std::string renamed = kText;
  renamed.replace(renamed.find("a square"), 8, "the same");
  EXPECT_EQ(load_text(renamed).hash, hash);
}

// It says where errors are told, and nothing of radiance: references and committed reports keep their hashes.
TEST_F(SceneFile, AViewMayHaveARegion) {
  const auto with = [](const std::string& region) {
    std::string text = kText;
    return text.replace(text.find("\"camera\""), 0, "\"region\": " + region + ",\n    ");
  };
  const Scene plain = load_text(kText), scene = load_text(with("[0.25, 0, 0.75, 0.5]"));
  EXPECT_FALSE(plain.region);
  ASSERT_TRUE(scene.region);
  EXPECT_EQ(scene.region->x0, 0.25);
  EXPECT_EQ(scene.region->y0, 0);
  EXPECT_EQ(scene.region->x1, 0.75);
  EXPECT_EQ(scene.region->y1, 0.5);
  EXPECT_EQ(scene.hash, plain.hash);
  const auto error_of_region = [&](const std::string& region) -> std::string {
    try {
      load_text(with(region));
      return "";
    } catch (const Error& e) {
      return e.what();
    }
  };
  EXPECT_EQ(error_of_region("[0, 0, 1, 1]"), "");
  EXPECT_TRUE(contains(error_of_region("[0.5, 0, 0.5, 1]"),
                       "scene.json:7: 'views/A/region' has x0 = 0.5, which is not below x1 = 0.5"));
  EXPECT_TRUE(contains(error_of_region("[0, 0.75, 1, 0.5]"), "has y0 = 0.75, which is not below y1 = 0.5"));
  EXPECT_TRUE(contains(error_of_region("[0, 0, 1, 1.5]"), "scene.json:7: 'views/A/region/3'"));
  EXPECT_TRUE(contains(error_of_region("[-0.5, 0, 1, 1]"), "'views/A/region/0'"));
  EXPECT_TRUE(contains(error_of_region("[0, 0, 1]"), "'views/A/region'"));
  EXPECT_TRUE(contains(error_of_region("[0, 0, 1, 1, 1]"), "'views/A/region'"));
  EXPECT_TRUE(contains(error_of_region("\"all\""), "'views/A/region'"));
}

TEST_F(SceneFile, NearAndFarEncloseTheGeometry) {
  const Scene scene = load_text(kText);
  const View camera = camera_view(scene.camera, 480, 272), light = light_view(scene.light);
  for (const glm::vec3& p : scene.positions) {
    for (const View& view : {camera, light}) {
      const float depth = glm::dot(p - view.position, view.forward);
      EXPECT_GT(depth, view.near);
      EXPECT_LT(depth, view.far);
    }
  }
}

TEST_F(SceneFile, SunCoversTheSceneByDefault) {
  std::string text = kText;
  const size_t at = text.find("{\"spot\""), end = text.find("}}}},");
  text.replace(at, end - at + 2, "{\"sun\": {\"direction\": [1, 0, -1], \"irradiance\": 8}}");
  const Scene scene = load_text(text);
  EXPECT_EQ(scene.light.power, glm::vec3(8));
  const View view = light_view(scene.light);
  for (const glm::vec3& p : scene.positions) {
    EXPECT_TRUE(view.project(p).has_value());
    const float depth = glm::dot(p - view.position, view.forward);
    EXPECT_GT(depth, view.near);
    EXPECT_LT(depth, view.far);
  }
  // The square's shadow: cos 45 degrees wide and 1 high, in centimetres; 0.1 % margin each.
  EXPECT_NEAR(frustum_flux(scene.light).x, 8 * 1e-4 * std::sqrt(0.5) * 1.001 * 1.001, 1e-9);
}

TEST_F(SceneFile, ErrorsNameTheLine) {
  EXPECT_TRUE(contains(error_of("\"vfov\"", "\"vfof\""), "scene.json:7:"));
  EXPECT_TRUE(contains(error_of("\"intensity\": [40000, 0, 0]", "\"intensity\": 1, \"fow\": 3"),
                       "did you mean 'fov'"));
  EXPECT_TRUE(contains(error_of("\"fov\": 60", "\"fov\": 180"), ":8: 'views/A/light/spot/fov'"));
  EXPECT_TRUE(
      contains(error_of("[0, 0, -2]", "[0, 0, 0]"), ":8: 'views/A/light/spot/direction' has no length"));
  EXPECT_TRUE(contains(error_of("[50, 0, 0]", "[0, 0, 400]"), ":7:"));
  EXPECT_TRUE(contains(error_of("\"target\"", "\"direction\": [1, 0, 0], \"target\""),
                       "either 'direction' or 'target'"));
  EXPECT_TRUE(contains(
      error_of("\"spot\": {", "\"sun\": {\"direction\": [0, -1, 0], \"irradiance\": 1}, \"spot\": {"),
      "one light"));
  EXPECT_TRUE(contains(error_of("(def*", "wood"), ":5: 'materials/0/match' 'wood' matches no material"));
  EXPECT_TRUE(contains(error_of("\"default_view\": \"A\"", "\"default_view\": \"B\""), ":9:"));
  EXPECT_TRUE(contains(error_of("scene.gltf", "absent.gltf"), ":3: 'geometry/file' names"));
  EXPECT_TRUE(
      contains(error_of("\"file\": \"scene.gltf\"", "\"builder\": \"cornel\""), "builders use metres"));
  EXPECT_TRUE(contains(error_of("\"unit\": 0.01", "\"unit\": 0"), ":4: 'unit'"));
  EXPECT_TRUE(contains(error_of("[0, 0, 400]", "[0, 0, 1e300]"), "too large"));
  EXPECT_TRUE(contains(error_of("40000,", "-1,"), ":8:"));
}

TEST_F(SceneFile, BuilderErrorsNameTheLine) {
  std::string text = kText;
  text.replace(text.find("\"unit\": 0.01,"), 13, "");
  text.replace(text.find("\"file\": \"scene.gltf\""), 20,
               "\"builder\": \"ring514\", \"parameters\": {\"size\": 2}");
  try {
    load_text(text);
    FAIL();
  } catch (const Error& e) {
    EXPECT_TRUE(contains(e.what(), "scene.json:3: 'geometry' unknown parameter 'size'"));
  }
}

TEST_F(SceneFile, LightStraightDownGetsAnotherUp) {
  std::string text = kText;
  text.replace(text.find("[0, 0, -2]"), 10, "[0, -1, 0]");
  const Light light = load_text(text).light;
  EXPECT_NEAR(glm::length(light.up), 1, 1e-6);
  EXPECT_NEAR(glm::dot(light.up, light.direction), 0, 1e-6);
}

TEST_F(SceneFile, NamesAndViews) {
  EXPECT_EQ(load_scene("colonnade", shipped()).name, "colonnade");
  const Scene cut = load_scene("colonnade:cut", shipped());
  EXPECT_EQ(cut.name, "colonnade:cut");
  EXPECT_NE(cut.hash, load_scene("colonnade:aisle", shipped()).hash);
  for (const auto& [name, part] :
       std::vector<std::pair<std::string, std::string>>{{"colonade", "did you mean 'colonnade'"},
                                                        {"colonnade:cat", "did you mean 'cut'"},
                                                        {"colonnade:", "no view"},
                                                        {"", "unknown scene"},
                                                        {"absent/scene.json", "cannot be read"}}) {
    try {
      load_scene(name, shipped());
      FAIL() << name;
    } catch (const Error& e) {
      EXPECT_TRUE(contains(e.what(), part));
    }
  }
}

TEST(ShippedScenes, AllAreListed) {
  std::vector<std::string> names;
  for (const SceneInfo& info : list_scenes(shipped())) {
    names.push_back(info.name);
    EXPECT_FALSE(info.description.empty());
    EXPECT_EQ(info.asset.empty(), info.get_it.empty()) << info.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"colonnade", "colonnade-dynamic", "columns-walk", "conference",
                                             "conference-published", "cornell", "cornell-glossy", "ring514",
                                             "ring514-turning", "sponza", "sponza-dynamic"}));
}

TEST(ShippedScenes, AbsentAssetSaysWhichAndWhere) {
  try {
    load_scene("sponza:D_columns_spot", {shipped().scenes_dir, "/nonexistent"});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::asset_missing);
    EXPECT_TRUE(contains(e.what(), "crytek-sponza/sponza.gltf"));
    EXPECT_TRUE(contains(e.what(), "https://"));
  }
}

// The real files, where they are present; the answer without them is the test above.
TEST(ShippedScenes, RealOnesLoadWhereTheyArePresent) {
  const SceneOptions options = shipped();
  const std::map<std::string, size_t> counts = {{"conference", 259499},
                                                {"conference-published", 331179},
                                                {"sponza", 262267},
                                                {"sponza-dynamic", 264465}};
  for (const SceneInfo& info : list_scenes(options)) {
    if (info.asset.empty()) continue;
    for (const std::string& view : info.views) {
      if (!info.asset_present) {
        EXPECT_THROW(load_scene(info.name + ":" + view, options), Error);
        continue;
      }
      const Scene scene = load_scene(info.name + ":" + view, options);
      EXPECT_EQ(scene.triangles.size(), counts.at(info.name));
      EXPECT_GT(scene.diagonal(), 5);
      EXPECT_LT(scene.diagonal(), 60);
      EXPECT_GT(glm::length(scene.light.power), 0);
    }
  }
}

}  // namespace
}  // namespace vsglbench
