#include "scene/gltf.h"

#include <unistd.h>

#include <cstdlib>

#include "scene/gltf_fixture.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

class Gltf : public GltfFixture {
 protected:
  void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
  }
};

TEST_F(Gltf, ReadsASquareAndRebasesIt) {
  add_square();
  const Scene scene = load(2);
  ASSERT_EQ(scene.triangles.size(), 2u);
  expect_near(scene.origin, {1, 1, 0});
  expect_near(world(scene, 2), {2, 2, 0});
  EXPECT_FLOAT_EQ(scene.bounds_max.x, 1);
  ASSERT_EQ(scene.batches.size(), 1u);
  EXPECT_EQ(scene.materials[scene.batches[0].material].name, "(default)");
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(Gltf, GlbEqualsGltf) {
  add_square();
  const Scene text = load();
  write("scene.glb", glb_bytes());
  const Scene binary = load_file(folder_ / "scene.glb");
  EXPECT_EQ(scene_hash(text), scene_hash(binary));
}

TEST_F(Gltf, AllIndexTypesAndNoneGiveTheSameTriangles) {
  add_square();
  const std::string hash = scene_hash(load());
  primitive()["indices"] = add<uint8_t>({0, 1, 2, 0, 2, 3}, 5121, "SCALAR", 1);
  EXPECT_EQ(scene_hash(load()), hash);
  primitive()["indices"] = add<uint32_t>({0, 1, 2, 0, 2, 3}, 5125, "SCALAR", 1);
  EXPECT_EQ(scene_hash(load()), hash);
  primitive().erase("indices");
  primitive()["mode"] = 6;  // the same two triangles as a fan, without indices
  const Scene fan = load();
  ASSERT_EQ(fan.triangles.size(), 2u);
  EXPECT_EQ(fan.triangles[0], glm::uvec3(1, 2, 0));
}

TEST_F(Gltf, StripsKeepTheirWinding) {
  primitive()["attributes"]["POSITION"] =
      add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 3);
  primitive()["mode"] = 5;
  const Scene scene = load();
  ASSERT_EQ(scene.triangles.size(), 3u);
  for (const glm::vec3& n : scene.normals) EXPECT_FLOAT_EQ(n.z, 1);
}

TEST_F(Gltf, MissingNormalsAreFlat) {
  // Two triangles that share an edge at a right angle.
  primitive()["attributes"]["POSITION"] = add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  primitive()["indices"] = add<uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
  const Scene scene = load();
  ASSERT_EQ(scene.positions.size(), 6u);
  for (int k = 0; k < 3; ++k) {
    expect_near(scene.normals[scene.triangles[0][k]], {0, 0, 1});
    expect_near(scene.normals[scene.triangles[1][k]], {1, 0, 0});
  }
}

TEST_F(Gltf, MissingTangentsFollowTheUvs) {
  add_square();
  const Scene upright = load();
  for (const glm::vec4& t : upright.tangents) {
    expect_near(glm::vec3(t), {1, 0, 0});
    EXPECT_EQ(t.w, 1);  // cross(+z, +x) = +y, up the image
  }
  primitive()["attributes"]["TEXCOORD_0"] = add_floats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2", 2);  // mirrored
  for (const glm::vec4& t : load().tangents) {
    expect_near(glm::vec3(t), {-1, 0, 0});
    EXPECT_EQ(t.w, -1);
  }
  primitive()["attributes"].erase("TEXCOORD_0");
  for (const glm::vec4& t : load().tangents) {
    EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
    EXPECT_NEAR(t.z, 0, 1e-6);  // orthogonal to the normal
  }
}

TEST_F(Gltf, NodesComposeTheirTransforms) {
  add_square();
  json_["nodes"] = Json::parse(R"([{"translation": [10, 0, 0], "children": [1, 2]},
    {"rotation": [0, 0, 0.70710678118654752, 0.70710678118654752], "scale": [2, 1, 1], "mesh": 0},
    {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1], "mesh": 0}])");
  const Scene scene = load();
  ASSERT_EQ(scene.triangles.size(), 4u);  // the mesh stands twice
  expect_near(world(scene, 1), {10, 2, 0});
  expect_near(world(scene, 3), {9, 0, 0});
  expect_near(world(scene, 4), {10, 0, 7});
}

TEST_F(Gltf, FarFromTheOriginKeepsItsDigits) {
  add_square();
  json_["nodes"][0]["translation"] = {1e7, 0, 0};
  const Scene scene = load();
  EXPECT_EQ(scene.positions[1].x - scene.positions[0].x, 1);
  EXPECT_DOUBLE_EQ(scene.origin.x, 1e7 + 0.5);
}

TEST_F(Gltf, NonUniformScaleTurnsNormalsByTheInverseTranspose) {
  add_square();
  primitive()["attributes"]["NORMAL"] =
      add_floats({0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f}, "VEC3", 3);
  json_["nodes"][0]["scale"] = {2, 1, 1};
  const glm::dvec3 expected = glm::normalize(glm::dvec3(0.3, 0, 0.8));
  for (const glm::vec3& n : load().normals) expect_near(n, expected);
}

TEST_F(Gltf, MirroringTurnsWindingAndHandednessOver) {
  add_square();
  json_["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = load();
  for (const glm::uvec3& t : scene.triangles) {
    const glm::vec3 n =
        glm::cross(scene.positions[t.y] - scene.positions[t.x], scene.positions[t.z] - scene.positions[t.x]);
    EXPECT_GT(glm::dot(n, scene.normals[t.x]), 0);
  }
  for (size_t i = 0; i < scene.normals.size(); ++i) {
    expect_near(scene.normals[i], {0, 0, 1});
    // The bitangent still points up the image, to +y.
    const glm::vec4 t = scene.tangents[i];
    expect_near(t.w * glm::cross(scene.normals[i], glm::vec3(t)), {0, 1, 0});
  }
}

TEST_F(Gltf, GivenTangentsSurviveAMirror) {
  add_square();
  primitive()["attributes"]["TANGENT"] =
      add_floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
  json_["nodes"][0]["scale"] = {-1, 1, 1};
  for (const glm::vec4& t : load().tangents) {
    expect_near(glm::vec3(t), {-1, 0, 0});
    EXPECT_EQ(t.w, -1);
  }
}

TEST_F(Gltf, ReadsTexturesFromFileDataUriAndBufferView) {
  add_square();
  const std::string png = decode_base64(kPngBase64);
  write("red image.png", png);
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", png.size()}});
  bin_ += png;
  json_["images"] = {{{"uri", "red%20image.png"}},
                     {{"uri", std::string("data:image/png;base64,") + kPngBase64}},
                     {{"bufferView", json_["bufferViews"].size() - 1}, {"mimeType", "image/png"}}};
  json_["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
  json_["materials"] =
      Json::parse(R"([{"name": "m", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
    "metallicRoughnessTexture": {"index": 1}, "metallicFactor": 0.25, "roughnessFactor": 0.5},
    "normalTexture": {"index": 2, "scale": 0.5}, "alphaMode": "MASK", "alphaCutoff": 0.3, "doubleSided": true}])");
  primitive()["material"] = 0;
  const Scene scene = load();
  ASSERT_EQ(scene.textures.size(), 3u);
  EXPECT_TRUE(scene.textures[0].srgb);
  EXPECT_FALSE(scene.textures[1].srgb);
  for (const Texture& t : scene.textures) {
    ASSERT_EQ(t.rgba.size(), 16u);
    EXPECT_EQ(t.rgba[0], 255);
    EXPECT_EQ(t.rgba[5], 255);
    EXPECT_EQ(t.rgba[15], 0);
  }
  const Material& m = scene.materials[0];
  EXPECT_FLOAT_EQ(m.alpha_cutoff, 0.3f);
  EXPECT_FLOAT_EQ(m.normal_scale, 0.5f);
  EXPECT_FLOAT_EQ(m.roughness, 0.5f);
  EXPECT_TRUE(is_hole(scene, 0, {0.5f, 0.25f}));  // uv (0.75, 0.75): the image's last texel
}

TEST_F(Gltf, UnusedTexturesAreNotNeeded) {
  add_square();
  json_["images"] = {{{"uri", "absent.png"}}};
  json_["textures"] = {{{"source", 0}}};
  EXPECT_EQ(load().textures.size(), 0u);
}

TEST_F(Gltf, ListsWhatItIgnores) {
  add_square();
  json_["materials"] =
      Json::parse(R"([{"name": "glass", "alphaMode": "BLEND", "emissiveFactor": [1, 0, 0]}])");
  json_["extensionsUsed"] = {"KHR_materials_clearcoat"};
  primitive()["material"] = 0;
  json_["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  const Scene scene = load();
  EXPECT_FLOAT_EQ(scene.materials[0].alpha_cutoff, 0.5f);
  for (const char* part : {"blending", "emission", "KHR_materials_clearcoat", "points and lines"}) {
    EXPECT_TRUE(warned(scene, {part})) << part;
  }
}

TEST_F(Gltf, SparseAccessorsReplaceElements) {
  add_square();
  const int indices = add<uint16_t>({2}, 5123, "SCALAR", 1), values = add_floats({5, 1, 0}, "VEC3", 3);
  json_["accessors"][0]["sparse"] = {{"count", 1},
                                     {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                     {"values", {{"bufferView", values}}}};
  const Scene scene = load();
  expect_near(world(scene, 2), {5, 1, 0});
  json_["accessors"][0]["sparse"]["count"] = 2;
  EXPECT_TRUE(contains(problem(), "leave buffer view"));
}

TEST_F(Gltf, NormalisedIntegersAreFractions) {
  add_square();
  primitive()["attributes"]["TEXCOORD_0"] =
      add<uint16_t>({0, 65535, 65535, 65535, 65535, 0, 0, 0}, 5123, "VEC2", 2);
  json_["accessors"].back()["normalized"] = true;
  const Scene scene = load();
  EXPECT_EQ(scene.uvs[1], glm::vec2(1, 1));
}

TEST_F(Gltf, ZeroAreaTrianglesAreKeptAndCounted) {
  add_square();
  primitive()["indices"] = add<uint16_t>({0, 1, 2, 0, 2, 3, 1, 1, 2}, 5123, "SCALAR", 1);
  const Scene scene = load();
  EXPECT_EQ(scene.triangles.size(), 3u);
  EXPECT_TRUE(warned(scene, {"1 of 3 triangles have no area"}));
}

}  // namespace
}  // namespace vsglbench
