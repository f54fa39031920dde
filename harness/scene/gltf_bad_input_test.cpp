// Every malformed file is an Error of one line that names the file; nothing crashes.
#include <unistd.h>

#include <cmath>
#include <limits>

#include "scene/gltf_fixture.h"
#include "scene/gltf_material.h"

namespace vsglbench {
namespace {

class GltfBadInput : public GltfFixture {
 protected:
  void SetUp() override {
    GltfFixture::SetUp();
    add_square();
  }
  // The problem after setting the value at a JSON pointer.
  std::string after(const std::string& pointer, const Json& value) {
    const Json before = json_;
    json_[Json::json_pointer(pointer)] = value;
    std::string text = problem();
    json_ = before;
    return text;
  }
};

TEST_F(GltfBadInput, MissingFile) {
  EXPECT_TRUE(contains(problem_of((folder_ / "absent.gltf").string()), "cannot be read"));
  EXPECT_TRUE(contains(problem_of(folder_.string()), "folder"));
}

TEST_F(GltfBadInput, TruncatedText) {
  write_gltf();
  const std::string text = json_.dump(1);
  for (size_t length = 0; length + 1 < text.size(); ++length) {
    write("cut.gltf", text.substr(0, length));
    EXPECT_TRUE(contains(problem_of((folder_ / "cut.gltf").string()), "not JSON")) << length;
  }
}

TEST_F(GltfBadInput, WhatIsNoGltfAtAllIsNamed) {
  const auto said = [&](const char* name, const std::string& bytes) {
    write(name, bytes);
    return problem_of((folder_ / name).string());
  };
  EXPECT_TRUE(contains(said("a.glb", ""), "is empty"));
  EXPECT_TRUE(contains(said("a.GLB", "<!doctype html>"), "doesn't begin with 'glTF'"));
  for (const char* name : {"a.glb", "a.gltf"})
    EXPECT_TRUE(contains(said(name, "version https://git-lfs.github.com/spec/v1\noid"), "git lfs pull"));
  // JSON under the other name loads.
  write_gltf();
  EXPECT_EQ(said("text.glb", json_.dump()), "");
}

TEST_F(GltfBadInput, GlbTruncatedAtEveryLength) {
  const std::string bytes = glb_bytes();
  for (size_t length = 0; length < bytes.size(); ++length) {
    write("cut.glb", bytes.substr(0, length));
    EXPECT_NE(problem_of((folder_ / "cut.glb").string()), "") << length;
  }
  write("whole.glb", bytes);
  EXPECT_EQ(problem_of((folder_ / "whole.glb").string()), "");
}

// Each byte replaced in turn, by several values: the loader may accept or refuse, but must survive.
TEST_F(GltfBadInput, GlbWithAnyByteChanged) {
  const std::string bytes = glb_bytes();
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const int value : {0x00, 0x7f, 0x39}) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(value);
      write("changed.glb", changed);
      problem_of((folder_ / "changed.glb").string());
    }
  }
}

TEST_F(GltfBadInput, TruncatedOrMissingBuffer) {
  const std::string path = write_gltf();
  write("data.bin", bin_.substr(0, bin_.size() / 2));
  EXPECT_TRUE(contains(problem_of(path), "data.bin"));
  std::filesystem::remove(folder_ / "data.bin");
  EXPECT_TRUE(contains(problem_of(path), "data.bin"));
}

TEST_F(GltfBadInput, AccessorsOutOfRange) {
  EXPECT_TRUE(contains(after("/accessors/0/count", 5), "POSITION: 5 elements of 12 bytes"));
  EXPECT_TRUE(contains(after("/accessors/0/count", 1ull << 62), "leave buffer view"));
  EXPECT_TRUE(contains(after("/accessors/0/byteOffset", 4), "leave buffer view"));
  EXPECT_TRUE(contains(after("/accessors/0/byteOffset", ~0ull), "leave buffer view"));
  EXPECT_TRUE(contains(after("/accessors/0/bufferView", 77), "past the 4"));
  EXPECT_TRUE(contains(after("/accessors/0/type", "VEC2"), "components"));
  EXPECT_TRUE(contains(after("/accessors/1/count", 3), "3 elements but 4 positions"));
  EXPECT_TRUE(contains(after("/accessors/3/componentType", 5126), "unsigned"));
  EXPECT_TRUE(contains(after("/accessors/0/componentType", 5124), "not allowed"));
  EXPECT_TRUE(contains(after("/bufferViews/0/byteStride", 4), "byteStride"));
  EXPECT_TRUE(contains(after("/bufferViews/0/byteLength", 1ull << 40), "leaves its buffer"));
  EXPECT_TRUE(contains(after("/bufferViews/0/byteOffset", ~0ull - 3), "leaves its buffer"));
  EXPECT_TRUE(contains(after("/bufferViews/0/buffer", 3), "past the 1"));
  EXPECT_NE(after("/bufferViews/0/buffer", -1), "");
}

TEST_F(GltfBadInput, ZeroFilledAccessorIsBounded) {
  json_["accessors"][0].erase("bufferView");
  EXPECT_TRUE(contains(after("/accessors/0/count", 1ull << 40), "no buffer view"));
}

TEST_F(GltfBadInput, ReferencesOutOfRange) {
  EXPECT_TRUE(contains(after("/meshes/0/primitives/0/attributes/POSITION", 99), "past the"));
  EXPECT_TRUE(contains(after("/meshes/0/primitives/0/material", 0), "material"));
  EXPECT_TRUE(contains(after("/nodes/0/mesh", 4), "mesh"));
  EXPECT_TRUE(contains(after("/scenes/0/nodes", {5}), "node"));
  EXPECT_TRUE(contains(after("/scenes/0/nodes", {-1}), "node"));
  EXPECT_TRUE(contains(after("/scene", 2), "default scene"));
  EXPECT_TRUE(contains(after("/nodes/0/children", {9}), "node"));
  EXPECT_TRUE(contains(after("/meshes/0/primitives/0/mode", 9), "mode"));
}

TEST_F(GltfBadInput, IndexPastTheVertices) {
  primitive()["indices"] = add<uint16_t>({0, 1, 4}, 5123, "SCALAR", 1);
  EXPECT_TRUE(contains(problem(), "index 2 is 4, past the 4 vertices"));
  primitive()["indices"] = add<uint16_t>({0, 1, 2, 3}, 5123, "SCALAR", 1);
  EXPECT_TRUE(contains(problem(), "whole number of triangles"));
}

TEST_F(GltfBadInput, VerticesThatAreNotFinite) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    primitive()["attributes"]["POSITION"] = add_floats({0, 0, 0, 1, bad, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    EXPECT_TRUE(contains(problem(), "POSITION: element 1 is not finite"));
  }
  primitive()["attributes"]["POSITION"] = add_floats({0, 0, 0, 1e30f, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  EXPECT_TRUE(contains(problem(), "metres off"));
}

TEST_F(GltfBadInput, NodesThatFormNoTree) {
  json_["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1]}, {"children": [0]}])");
  EXPECT_TRUE(contains(problem(), "cycle"));
  json_["nodes"] = Json::parse(R"([{"mesh": 0, "matrix": [1, 2, 3]}])");
  EXPECT_TRUE(contains(problem(), "matrix"));
  json_["nodes"] = Json::parse(R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])");
  EXPECT_TRUE(contains(problem(), "rotation"));
}

TEST_F(GltfBadInput, Textures) {
  json_["images"] = {{{"uri", "absent.png"}}};
  json_["textures"] = {{{"source", 0}}};
  json_["materials"] =
      Json::parse(R"([{"name": "wood", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  primitive()["material"] = 0;
  EXPECT_TRUE(contains(problem(), "wood"));
  EXPECT_TRUE(contains(problem(), "absent.png"));
  write("absent.png", "this is no image");
  EXPECT_TRUE(contains(problem(), "is not an image"));
  write("absent.png", decode_base64(kPngBase64).substr(0, 60));
  EXPECT_TRUE(contains(problem(), "is not an image"));
  EXPECT_TRUE(contains(after("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 3), "past the 1"));
  EXPECT_TRUE(contains(after("/textures/0/source", 8), "past the 1"));
  EXPECT_TRUE(contains(after("/images/0", {{"bufferView", 0}}), "is not an image"));
  EXPECT_TRUE(contains(after("/images/0", {{"bufferView", 50}}), "image 0: buffer view: index 50"));
  EXPECT_TRUE(contains(after("/materials/0/alphaMode", "SHINY"), "SHINY"));
}

// The library made room for what the PNG's chunk or its size states, up to 1 GiB, before it found it too
// short.
TEST_F(GltfBadInput, APngThatPromisesMoreThanItHoldsTakesNoMemory) {
  const auto peak_kib = [] {
    std::ifstream status("/proc/self/status");
    long kib = 0;
    for (std::string word; status >> word;) {
      if (word == "VmPeak:") status >> kib;
    }
    return kib;
  };
  const std::string good = decode_base64(kPngBase64);
  const auto decoded = [](const std::string& png) {
    Texture texture;
    return decode_image(reinterpret_cast<const uint8_t*>(png.data()), png.size(), &texture);
  };
  ASSERT_TRUE(decoded(good));
  const long before = peak_kib();
  constexpr size_t kWidth = 16, kHeight = 20, kDataLength = 33;
  std::string wide = good, long_chunk = good;
  wide[kWidth + 2] = wide[kHeight + 2] = 0x3f;
  long_chunk[kDataLength] = 0x10;
  EXPECT_FALSE(decoded(wide));
  EXPECT_FALSE(decoded(long_chunk));
  EXPECT_LT(peak_kib() - before, 64 << 10);
}

TEST_F(GltfBadInput, NoTriangles) {
  EXPECT_TRUE(contains(after("/scenes/0/nodes", Json::array()), "no triangles"));
  primitive()["attributes"].erase("POSITION");
  EXPECT_TRUE(contains(problem(), "no POSITION"));
}

TEST_F(GltfBadInput, RequiredExtensionsAreNamedWithTheCommandThatRemovesThem) {
  const auto requiring = [&](const char* name) { return after("/extensionsRequired", {name}); };
  const std::pair<const char*, const char*> commands[] = {
      {"KHR_draco_mesh_compression", "cli copy IN.glb OUT.glb` decompresses"},
      {"EXT_meshopt_compression", "cli copy IN.glb OUT.glb` decompresses"},
      {"KHR_texture_basisu", "cli ktxdecompress IN.glb OUT.glb` turns"},
      {"EXT_texture_webp", "cli png IN.glb OUT.glb --formats '*'` turns"}};
  for (const auto& [name, command] : commands) {
    EXPECT_TRUE(contains(requiring(name), fmt::format("requires the extension {}, which is not read", name)));
    EXPECT_TRUE(contains(requiring(name), command));
  }
  EXPECT_TRUE(contains(requiring("ACME_new"), "requires the extension ACME_new, which is not read"));
  // What Draco's writers leave of a primitive: accessors without bytes.
  json_["accessors"][3].erase("bufferView");
  EXPECT_TRUE(contains(requiring("KHR_draco_mesh_compression"), "requires the extension KHR_draco"));
}

TEST_F(GltfBadInput, OtherVersionsAreNamed) {
  EXPECT_TRUE(contains(after("/asset/version", "1.0"), "is glTF version 1.0, but only version 2 is read"));
  EXPECT_TRUE(contains(after("/asset/version", "3.0"), "is glTF version 3.0, but only version 2 is read"));
  EXPECT_TRUE(contains(after("/asset/minVersion", "2.1"), "needs a reader of glTF version 2.1"));
  EXPECT_TRUE(contains(after("/asset/minVersion", "3.0"), "is glTF version 3.0"));
  EXPECT_EQ(after("/asset/version", "2.1"), "") << "a minor version of a reader's own major one";
  EXPECT_TRUE(contains(after("/asset", Json::object()), "no asset.version"));
  std::string bytes = glb_bytes();
  for (const char version : {1, 3}) {
    bytes[4] = version;
    write("old.glb", bytes);
    EXPECT_TRUE(contains(problem_of((folder_ / "old.glb").string()),
                         fmt::format("is glTF version {}, but only version 2 is read", int(version))));
  }
}

// Every kind of string that a file has: none is quoted at length, and none steers the terminal.
TEST_F(GltfBadInput, NamesAreExcerpts) {
  const std::string bad = "\x1b[2J" + std::string(1 << 20, 'n');
  const auto is_short = [](const std::string& text) {
    EXPECT_NE(text, "");
    EXPECT_LT(text.size(), 700u) << text.substr(0, 300);
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text.substr(0, 300);
  };
  json_["meshes"][0]["name"] = bad;
  is_short(after("/meshes/0/primitives/0/mode", 9));
  json_["nodes"][0]["name"] = bad;
  is_short(after("/nodes/0/rotation", {0, 0, 0, 0}));
  is_short(after("/extensionsRequired", {bad}));
  is_short(after("/extensionsUsed", {7}));
  is_short(after("/asset/version", bad));
  is_short(after("/accessors/0/type", bad));
  textured();
  json_["materials"][0]["name"] = bad;
  is_short(after("/materials/0/alphaMode", bad));
  is_short(after("/images/0", {{"uri", bad}}));
  is_short(after("/images/0", {{"uri", "data:image/png;base64," + std::string(2 << 20, 'A')}}));
  is_short(after("/images/0", {{"uri", "data:image/png;base64,AAAA"}, {"name", bad}}));
  is_short(after("/images/0", {{"uri", "data:" + bad}}));
}

TEST_F(GltfBadInput, BuffersThatAreNotThere) {
  const auto with = [&](const Json& buffer) {
    write_gltf();
    Json json = json_;
    json["buffers"][0] = buffer;
    write("scene.gltf", json.dump());
    return problem_of((folder_ / "scene.gltf").string());
  };
  EXPECT_TRUE(contains(with({{"uri", "data.bin"}}), "buffer 0: its byteLength is no number of bytes"));
  EXPECT_TRUE(contains(with({{"uri", "data.bin"}, {"byteLength", -1}}), "byteLength"));
  EXPECT_TRUE(contains(with({{"byteLength", 4}}), "buffer 0: has no uri"));
  EXPECT_TRUE(contains(with({{"uri", "https://x.org/data.bin"}, {"byteLength", 4}}), "must lie beside"));
  EXPECT_TRUE(contains(with({{"uri", "data:,abc"}, {"byteLength", 4}}), "its data URI has 3 bytes"));
  EXPECT_TRUE(contains(with({{"uri", "data:abc"}, {"byteLength", 4}}), "no comma"));
  EXPECT_TRUE(contains(with({{"uri", std::string(100000, 'n')}, {"byteLength", 4}}), "is missing"));
}

TEST_F(GltfBadInput, DeepNesting) {
  const std::string path = write_gltf();
  std::string deep = R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100000, '[');
  write("scene.gltf", deep + std::string(100000, ']') + "}");
  EXPECT_TRUE(contains(problem_of(path), "nested"));
}

}  // namespace
}  // namespace vsglbench
