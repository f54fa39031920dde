// Where textures lie on a mesh: sets of coordinates and KHR_texture_transform.
#include <numbers>

#include "scene/gltf_fixture.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

class GltfUv : public GltfFixture {
 protected:
  void SetUp() override {
    GltfFixture::SetUp();
    add_square();
  }
  static void expect_uvs(const Scene& scene, const std::vector<glm::vec2>& expected) {
    ASSERT_EQ(scene.uvs.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i)
      EXPECT_LT(glm::length(scene.uvs[i] - expected[i]), 1e-6f)
          << i << ": " << scene.uvs[i].x << " " << scene.uvs[i].y;
  }
};

TEST_F(GltfUv, OffsetAndScale) {
  textured()["extensions"]["KHR_texture_transform"] = {{"offset", {0.5, 0.25}}, {"scale", {2, -1}}};
  expect_uvs(load(), {{0.5, -0.75}, {2.5, -0.75}, {2.5, 0.25}, {0.5, 0.25}});
}

// The extension's own example: only the lower left quadrant of the image, turned by a quarter.
TEST_F(GltfUv, ARotationShowsTheLowerLeftQuadrant) {
  textured()["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
  const Scene scene = load();
  // Blue, the image's lower left texel, is all that a point well inside can see.
  for (const glm::vec2& b : {glm::vec2(0.2f, 0.4f), {0.5f, 0.25f}, {0.3f, 0.3f}}) {
    const glm::uvec3 t = scene.triangles[0];
    const glm::vec2 uv = (1 - b.x - b.y) * scene.uvs[t.x] + b.x * scene.uvs[t.y] + b.y * scene.uvs[t.z];
    EXPECT_GE(uv.x, 0);
    EXPECT_LE(uv.x, 0.5f);
    EXPECT_GE(uv.y, 0.5f);
    EXPECT_LE(uv.y, 1);
  }
  const glm::vec4 centre = sample_texture(scene.textures[0], {0.25f, 0.75f});
  EXPECT_EQ(centre, glm::vec4(0, 0, 1, 1));
  // Against the clock in the plane of the image: what ran right now runs up it.
  const glm::vec2 right = scene.uvs[1] - scene.uvs[0];
  EXPECT_LT(glm::length(right - glm::vec2(0, -0.5)), 1e-6f);
}

TEST_F(GltfUv, TheSetThatTheTextureOrItsTransformNames) {
  primitive()["attributes"]["TEXCOORD_1"] = add_floats({5, 5, 6, 5, 6, 6, 5, 6}, "VEC2", 2);
  primitive()["attributes"]["TEXCOORD_2"] = add_floats({8, 8, 9, 8, 9, 9, 8, 9}, "VEC2", 2);
  textured()["texCoord"] = 1;
  expect_uvs(load(), {{5, 5}, {6, 5}, {6, 6}, {5, 6}});
  textured()["extensions"]["KHR_texture_transform"] = {{"texCoord", 2}};
  expect_uvs(load(), {{8, 8}, {9, 8}, {9, 9}, {8, 9}});
  textured()["texCoord"] = 3;
  EXPECT_TRUE(warned(load(), {"mesh 0 primitive 0", "no TEXCOORD_3"}));
}

// A texture of any slot counts, and one that lies elsewhere is named.
TEST_F(GltfUv, EverySlotHasItsTransform) {
  const Json transform = {{"KHR_texture_transform", {{"scale", {4, 4}}}}};
  for (const char* slot : {"/normalTexture", "/pbrMetallicRoughness/metallicRoughnessTexture"}) {
    textured();
    json_["materials"][0] = {{"name", "m"}};
    json_["materials"][0][Json::json_pointer(slot)] = {{"index", 0}, {"extensions", transform}};
    expect_uvs(load(), {{0, 4}, {4, 4}, {4, 0}, {0, 0}});
  }
  textured();
  json_["materials"][0]["normalTexture"] = {{"index", 0}, {"extensions", transform}};
  EXPECT_TRUE(warned(load(), {"material m: normalTexture lies elsewhere than baseColorTexture"}));
  json_["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = transform;
  EXPECT_FALSE(warned(load(), {"lies elsewhere"}));
}

// As gltfpack writes: integers of 12 of their 16 bits, scaled back by the texture.
TEST_F(GltfUv, QuantisedCoordinatesAreScaledBack) {
  primitive()["attributes"]["TEXCOORD_0"] =
      add<uint16_t>({0, 4095, 4095, 4095, 4095, 0, 0, 0}, 5123, "VEC2", 2);
  json_["accessors"].back()["normalized"] = true;
  textured()["extensions"]["KHR_texture_transform"] = {{"scale", {65535.0 / 4095, 65535.0 / 4095}}};
  expect_uvs(load(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
}

TEST_F(GltfUv, WhatIsMalformedIsSaid) {
  for (const Json& bad : {Json({{"offset", {1}}}), Json({{"scale", "two"}}), Json({{"rotation", {1}}}),
                          Json({{"scale", {1e30, 1}}}), Json({{"texCoord", -1}})}) {
    textured()["extensions"]["KHR_texture_transform"] = bad;
    EXPECT_TRUE(contains(problem(), "material m: baseColorTexture: ")) << bad;
  }
}

}  // namespace
}  // namespace vsglbench
