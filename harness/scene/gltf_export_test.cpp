#include "scene/gltf_export.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "scene/gltf_fixture.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

class Exports : public GltfFixture {
 protected:
  SceneOptions shipped() const { return {std::filesystem::path(VSGLBENCH_SOURCE_DIR) / "scenes", ""}; }

  // Positions in the world, each within a millionth of the scene's size.
  static void expect_same_triangles(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    const double slack = 1e-6 * a.diagonal();
    for (size_t i = 0; i < a.triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = glm::dvec3(a.positions[a.triangles[i][k]]) + a.origin;
        const glm::dvec3 q = glm::dvec3(b.positions[b.triangles[i][k]]) + b.origin;
        ASSERT_LT(glm::length(p - q), slack) << i;
      }
    }
  }
  static void expect_same_view(const Scene& a, const Scene& b) {
    const auto near = [&](const glm::vec3& x, const glm::vec3& y) {
      EXPECT_LT(glm::length(x - y), 1e-5f) << x.x << " " << y.x;
    };
    const auto at = [](const Scene& s, const glm::vec3& p) { return glm::vec3(glm::dvec3(p) + s.origin); };
    near(at(a, a.camera.position), at(b, b.camera.position));
    near(a.camera.direction, b.camera.direction);
    near(a.camera.up, b.camera.up);
    EXPECT_NEAR(a.camera.vfov, b.camera.vfov, 1e-6);
    EXPECT_EQ(a.light.type, b.light.type);
    near(at(a, a.light.position), at(b, b.light.position));
    near(a.light.direction, b.light.direction);
    near(a.light.up, b.light.up);
    near(a.light.power / a.light.power.x, b.light.power / a.light.power.x);
    EXPECT_NEAR(a.light.fov, b.light.fov, 1e-6);
    near(glm::vec3(a.light.half_extent, 0), glm::vec3(b.light.half_extent, 0));
  }
};

// By the glTF alone, and by the scene.json beside it, which also has the materials.
TEST_F(Exports, LoadAgainAsTheSameScene) {
  for (const char* name : {"cornell", "ring514"}) {
    const Scene scene = load_scene(name, shipped());
    export_scene(scene, folder_, 32, 18);
    const Scene by_model = load_scene((folder_ / "scene.gltf").string(), {});
    expect_same_triangles(scene, by_model);
    expect_same_view(scene, by_model);
    const Scene by_file = load_scene(folder_.string(), {});
    expect_same_triangles(scene, by_file);
    expect_same_view(scene, by_file);
    for (size_t i = 0; i < scene.triangles.size(); i += 7) {
      const Material &a = scene.materials[scene.triangle_material[i]],
                     &b = by_file.materials[by_file.triangle_material[i]];
      EXPECT_EQ(a.base_color, b.base_color);
      EXPECT_EQ(a.specular, b.specular);
      EXPECT_EQ(a.phong_exponent, b.phong_exponent);
      EXPECT_EQ(a.metallic, b.metallic);
      EXPECT_EQ(a.roughness, b.roughness);
    }
  }
}

TEST_F(Exports, ASunKeepsItsRectangleAndTexturesTheirTexels) {
  add_square();
  json_["images"] = {{{"uri", "data:image/png;base64," + std::string(kPngBase64)}}};
  json_["textures"] = {{{"source", 0}}};
  json_["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  primitive()["material"] = 0;
  write_gltf();
  write("scene.json", R"({"name": "test", "description": "a square", "geometry": {"file": "scene.gltf"},
    "views": {"A": {"camera": {"eye": [0, 0, 4], "target": [0.5, 0, 0], "vfov": 45},
      "light": {"sun": {"direction": [1, 0, -2], "irradiance": [8, 4, 2], "centre": [0, 0, 3], "half_extent": [1, 2]}}}},
    "default_view": "A"})");
  const Scene scene = load_scene((folder_ / "scene.json").string(), {});
  export_scene(scene, folder_ / "out", 32, 18);
  const Scene again = load_scene((folder_ / "out").string(), {});
  expect_same_view(scene, again);
  ASSERT_EQ(again.textures.size(), 1u);
  EXPECT_EQ(again.textures[0].rgba, scene.textures[0].rgba);
  for (const char* file : {"README.md", "render_cycles.py", "facts.json"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
}

}  // namespace
}  // namespace vsglbench
