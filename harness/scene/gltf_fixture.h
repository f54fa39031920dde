// Small glTF files for the tests, written to a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/json.h"
#include "scene/check.h"
#include "scene/gltf.h"

namespace vsglbench {

// 2x2 texels: red, green / blue, transparent white.
constexpr const char* kPngBase64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR4nGP4z8DwHwyBNAgwAABIyQj4ccUx4AAAAABJRU5ErkJggg="
    "=";

inline std::string decode_base64(const std::string& text) {
  std::string out;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<uint32_t>(digit);
    if ((count += 6) >= 8) out += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  return out;
}

class GltfFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("vsglbench_{}_{}_{}", test->test_suite_name(), test->name(), ::getpid());
    std::filesystem::create_directories(folder_);
    json_ = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                            "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {}}]}],
                            "accessors": [], "bufferViews": []})");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Appends the values as a buffer view with an accessor of their type; the accessor's index.
  template <class T>
  int add(const std::vector<T>& values, int component_type, const char* type, size_t components) {
    while (bin_.size() % 4 != 0) bin_ += '\0';
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", values.size() * sizeof(T)}});
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component_type},
                                  {"count", values.size() / components},
                                  {"type", type}});
    bin_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return static_cast<int>(json_["accessors"].size()) - 1;
  }
  int add_floats(const std::vector<float>& values, const char* type, size_t components) {
    return add(values, 5126, type, components);
  }
  // A material "m" of the square whose base colour is the image of kPngBase64.
  Json& textured() {
    json_["images"] = {{{"uri", std::string("data:image/png;base64,") + kPngBase64}}};
    json_["textures"] = {{{"source", 0}}};
    json_["materials"] = {{{"name", "m"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    primitive()["material"] = 0;
    return json_["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  }
  // A skin of the mesh's node 0 with a joint a node, all weight on one joint a vertex unless `weights` says
  // else.
  void add_skin(const std::vector<int>& joints, const std::vector<uint8_t>& joint_of_vertex,
                const std::vector<float>& weights, const std::vector<float>& inverse_bind = {}) {
    json_["nodes"][0]["skin"] = 0;
    json_["skins"] = {{{"joints", joints}}};
    if (!inverse_bind.empty())
      json_["skins"][0]["inverseBindMatrices"] = add_floats(inverse_bind, "MAT4", 16);
    primitive()["attributes"]["JOINTS_0"] = add<uint8_t>(joint_of_vertex, 5121, "VEC4", 4);
    primitive()["attributes"]["WEIGHTS_0"] = add_floats(weights, "VEC4", 4);
  }
  Json& primitive() { return json_["meshes"][0]["primitives"][0]; }

  // A unit square in the plane z = 0, facing +z, with uvs upright in the image; indices as u16.
  void add_square() {
    primitive()["attributes"]["POSITION"] = add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    primitive()["attributes"]["NORMAL"] = add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    primitive()["attributes"]["TEXCOORD_0"] = add_floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
    primitive()["indices"] = add<uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
  }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  std::string write_gltf() {
    write("data.bin", bin_);
    json_["buffers"] = Json::array({{{"uri", "data.bin"}, {"byteLength", bin_.size()}}});
    write("scene.gltf", json_.dump(1));
    return (folder_ / "scene.gltf").string();
  }
  std::string glb_bytes() {
    while (bin_.size() % 4 != 0) bin_ += '\0';
    json_["buffers"] = Json::array({{{"byteLength", bin_.size()}}});
    std::string text = json_.dump();
    while (text.size() % 4 != 0) text += ' ';
    const auto number = [](size_t v) {
      const uint32_t n = static_cast<uint32_t>(v);
      return std::string(reinterpret_cast<const char*>(&n), 4);
    };
    return "glTF" + number(2) + number(28 + text.size() + bin_.size()) + number(text.size()) + "JSON" + text +
           number(bin_.size()) + std::string("BIN\0", 4) + bin_;
  }
  Scene load_file(const std::string& path, double unit = 1) const {
    Scene scene;
    load_gltf(path, unit, &scene);
    return scene;
  }
  Scene load(double unit = 1) { return load_file(write_gltf(), unit); }

  // The error's text, or "" when the file loads.
  std::string problem() { return problem_of(write_gltf()); }
  std::string problem_of(const std::string& path) const {
    try {
      Scene scene = load_file(path);
      scene.light.up = {0, 0, 1};
      check_scene(scene);  // whatever loads must also be sound
      return "";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::scene);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
      return e.what();
    }
  }

  // Where a vertex stands in the world.
  static glm::dvec3 world(const Scene& scene, size_t vertex) {
    return glm::dvec3(scene.positions[vertex]) + scene.origin;
  }
  // The first warning that contains all of the parts, or all warnings in a line.
  static ::testing::AssertionResult warned(const Scene& scene, const std::vector<std::string>& parts) {
    std::string all;
    for (const std::string& w : scene.warnings) {
      const auto has = [&w](const std::string& part) { return w.find(part) != std::string::npos; };
      if (std::all_of(parts.begin(), parts.end(), has)) return ::testing::AssertionSuccess() << w;
      all += w + " | ";
    }
    return ::testing::AssertionFailure() << "warnings: " << all;
  }

  std::filesystem::path folder_;
  Json json_;
  std::string bin_;
};

inline ::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << text << "' does not contain '" << part << "'";
}

}  // namespace vsglbench
