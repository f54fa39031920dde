// What is valid loads, and so does what is broken in a way that has one sound reading; a warning says which.
#include <cmath>

#include "scene/gltf_fixture.h"

namespace vsglbench {
namespace {

class GltfValid : public GltfFixture {
 protected:
  void SetUp() override {
    GltfFixture::SetUp();
    add_square();
  }
};

TEST_F(GltfValid, SkinsWithoutInverseBindMatrices) {
  json_["nodes"].push_back({{"name", "joint"}});
  json_["skins"] = {{{"joints", {1}}}};
  EXPECT_EQ(load().triangles.size(), 2u);
}

TEST_F(GltfValid, AnimationChannelsWithoutANode) {
  const int times = add_floats({0, 1}, "SCALAR", 1), values = add_floats({0, 1}, "SCALAR", 1);
  json_["animations"] = {
      {{"samplers", {{{"input", times}, {"output", values}}}},
       {"channels",
        {{{"sampler", 0},
          {"target",
           {{"path", "pointer"},
            {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0"}}}}}}}}}}}};
  json_["extensionsUsed"] = {"KHR_animation_pointer"};
  EXPECT_TRUE(warned(load(), {"animations are not played"}));
  Scene moving;
  moving.animation.frames = 2;
  load_gltf(write_gltf(), 1, &moving);
  EXPECT_TRUE(warned(moving, {"animation 0 channel 0", "no target node"}));
}

TEST_F(GltfValid, BuffersLongerThanTheirByteLength) {
  const std::string path = write_gltf();
  write("data.bin", bin_ + std::string(7, 'p'));
  EXPECT_EQ(load_file(path).triangles.size(), 2u);
  bin_ += "pppp";
  const std::string stated = fmt::format("\"byteLength\":{}}}]", bin_.size());
  std::string bytes = glb_bytes();
  ASSERT_NE(bytes.find(stated), std::string::npos);
  bytes.replace(bytes.find(stated), stated.size(), fmt::format("\"byteLength\":{}}}]", bin_.size() - 4));
  write("padded.glb", bytes);
  EXPECT_EQ(load_file((folder_ / "padded.glb").string()).triangles.size(), 2u);
}

TEST_F(GltfValid, ImagesWhateverTheirMimeTypeIsCalled) {
  for (const char* mime :
       {"image/png", "image/jpg", "image/webp", "image/x-png", "application/octet-stream"}) {
    textured();
    json_["images"][0]["uri"] = fmt::format("data:{};base64,{}", mime, kPngBase64);
    EXPECT_EQ(load().textures.size(), 1u) << mime;
  }
}

TEST_F(GltfValid, RequiredExtensionsOfWhatIsNotRead) {
  for (const char* name : {"KHR_lights_punctual", "KHR_materials_variants", "KHR_xmp_json_ld",
                           "KHR_animation_pointer", "KHR_texture_transform", "KHR_mesh_quantization"}) {
    json_["extensionsUsed"] = json_["extensionsRequired"] = {name};
    EXPECT_EQ(load().triangles.size(), 2u) << name;
  }
}

TEST_F(GltfValid, IndicesWithoutBytesAreZeros) {
  json_["accessors"][3].erase("bufferView");
  const Scene scene = load();
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.triangles[0], glm::uvec3(0));
}

// The face's normal, whatever is wrong with the vertex's.
TEST_F(GltfValid, NormalsThatAreNoNumbersAreRepairedAndCounted) {
  for (const float bad : {std::nanf(""), INFINITY, 0.0f}) {
    primitive()["attributes"]["NORMAL"] = add_floats({bad, bad, bad, 0, 0, 1, bad, 0, 0, 0, 0, 1}, "VEC3", 3);
    const Scene scene = load();
    EXPECT_TRUE(warned(scene, {"mesh 0 primitive 0", "2 normals"}));
    for (const glm::vec3& n : scene.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
  }
}

TEST_F(GltfValid, TangentsThatAreNoNumbersAreMadeAnew) {
  primitive()["attributes"]["TANGENT"] =
      add_floats({0, 1, 0, 1, 0, 1, 0, 1, NAN, 1, 0, 1, 0, 1, 0, 1}, "VEC4", 4);
  const Scene scene = load();
  EXPECT_TRUE(warned(scene, {"tangents are no numbers"}));
  for (const glm::vec4& t : scene.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));
}

TEST_F(GltfValid, ATextureWhoseImageStandsInAnExtension) {
  textured();
  json_["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  EXPECT_EQ(load().textures.size(), 1u) << "its image is a PNG after all";
  json_["images"][0]["uri"] = "data:image/webp;base64,UklGRhIAAABXRUJQVlA4";
  const Scene scene = load();
  EXPECT_EQ(scene.textures.size(), 0u);
  EXPECT_EQ(scene.materials[0].base_color_texture, -1);
  EXPECT_TRUE(warned(scene, {"material m: baseColorTexture", "EXT_texture_webp alone", "left out", "png"}));
  json_["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
  EXPECT_TRUE(warned(load(), {"KHR_texture_basisu alone", "ktxdecompress"}));
  json_["textures"][0] = Json::object();
  EXPECT_TRUE(warned(load(), {"material m: baseColorTexture", "names no image"}));
}

TEST_F(GltfValid, AMissingImageOfAMaterialThatNothingHas) {
  textured();
  json_["images"].push_back({{"uri", "absent.png"}});
  json_["textures"].push_back({{"source", 1}});
  json_["materials"].push_back({{"name", "spare"}, {"normalTexture", {{"index", 1}}}});
  const Scene scene = load();
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials[0].base_color_texture, 0);
  EXPECT_EQ(scene.materials[1].normal_texture, -1);
  EXPECT_TRUE(warned(scene, {"material spare", "absent.png", "missing"}));
  primitive()["material"] = 1;
  EXPECT_TRUE(contains(problem(), "material spare: normalTexture: its file 'absent.png' is missing"));
}

TEST_F(GltfValid, WhatIsNotUsedIsNamed) {
  json_["cameras"] =
      Json::parse(R"([{"name": "Front", "type": "perspective", "perspective": {"yfov": 1, "znear": 1}},
                                    {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
  primitive()["attributes"]["COLOR_0"] = add_floats(std::vector<float>(12, 1), "VEC3", 3);
  json_["meshes"][0]["primitives"].push_back(primitive());
  const Scene scene = load();
  EXPECT_TRUE(warned(scene, {"cameras are not used: 'Front', camera 1"}));
  EXPECT_TRUE(warned(scene, {"COLOR_0", "mesh 0 primitive 0", "2 primitives"}));
}

TEST_F(GltfValid, InstancesStandWhereTheExtensionSays) {
  json_["extensionsUsed"] = json_["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  json_["nodes"][0]["translation"] = {100, 0, 0};
  json_["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", add_floats({0, 0, 0, 0, 0, 5}, "VEC3", 3)},
      {"ROTATION", add<int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170}, 5122, "VEC4", 4)},
      {"SCALE", add_floats({1, 1, 1, 3, 1, 1}, "VEC3", 3)}};
  json_["accessors"][5]["normalized"] = true;
  const Scene scene = load();
  ASSERT_EQ(scene.triangles.size(), 4u);
  EXPECT_LT(glm::length(world(scene, 1) - glm::dvec3(101, 0, 0)), 1e-5);
  // Scaled along x, turned a quarter to y, moved along z, then by the node.
  EXPECT_LT(glm::length(world(scene, 5) - glm::dvec3(100, 3, 5)), 1e-4);
  json_["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      add_floats({1, 1, 1}, "VEC3", 3);
  EXPECT_TRUE(contains(problem(), "not the same number of instances"));
}

}  // namespace
}  // namespace vsglbench
