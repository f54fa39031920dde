// Tests only: a temporary folder, small experiments and scenes, and runs of them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/file.h"
#include "base/json.h"
#include "base/test_folders.h"
#include "report/report.h"

namespace vsglbench {

inline ::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << text << "' does not contain '" << part << "'";
}

class RunFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("vsglbench_{}_{}_{}", test->test_suite_name(), test->name(), ::getpid());
    std::filesystem::create_directories(folder_);
    out_ = folder_ / "out";
    ::setenv("VSGLBENCH_CACHE", test_cache().c_str(), 1);
    ::unsetenv("VSGLBENCH_ASSETS");
    config_ = Json::parse(R"({"name": "tiny", "scenes": ["cornell"], "methods": [{"method": "vpl"}],
                              "frame": {"width": 32, "height": 18}, "rsm": 16, "N": 16, "importance_lights": 16,
                              "seeds": 2, "reference": {"samples": 4, "batches": 2},
                              "timing": {"min_samples": 2, "max_samples": 2}})");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    write_text(folder_ / name, text);
    return folder_ / name;
  }
  std::filesystem::path write_config() const { return write("config.json", config_.dump(2)); }

  // A scene folder around one square wall, 2 m wide, in the plane z = 0, that a spot lights and a camera
  // sees. `geometry` is the .gltf; the square is not written when it is empty.
  Json square_scene(const std::string& geometry = "square.gltf") const {
    return {{"name", "square"},
            {"description", "one wall"},
            {"geometry", {{"file", geometry}}},
            {"default_view", "front"},
            {"views",
             {{"front",
               {{"camera", {{"eye", {0, 0, 4}}, {"direction", {0, 0, -1}}, {"vfov", 40}}},
                {"light",
                 {{"spot",
                   {{"position", {1, 1, 3}}, {"target", {0, 0, 0}}, {"fov", 40}, {"intensity", 5}}}}}}}}}};
  }

  // A box of triangles, open to the front, as glTF with its buffer inside: every wall sees the others.
  static Json box_gltf() {
    const std::vector<float> p = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0,
                                  -1, -1, 2, 1, -1, 2, 1, 1, 2, -1, 1, 2};
    const std::vector<uint16_t> i = {0, 1, 2, 0, 2, 3, 0, 4, 5, 0, 5, 1, 0, 3, 7, 0, 7, 4};
    std::string bytes(reinterpret_cast<const char*>(p.data()), p.size() * sizeof(float));
    bytes.append(reinterpret_cast<const char*>(i.data()), i.size() * sizeof(uint16_t));
    return {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}}}},
            {"meshes",
             {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
            {"materials", {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.8, 0.8, 1}}}}}}},
            {"accessors",
             {{{"bufferView", 0},
               {"componentType", 5126},
               {"count", 8},
               {"type", "VEC3"},
               {"min", {-1, -1, 0}},
               {"max", {1, 1, 2}}},
              {{"bufferView", 1}, {"componentType", 5123}, {"count", 18}, {"type", "SCALAR"}}}},
            {"bufferViews",
             {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 96}},
              {{"buffer", 0}, {"byteOffset", 96}, {"byteLength", 36}}}},
            {"buffers",
             {{{"byteLength", 132}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}}}};
  }

  static std::string base64(const std::string& bytes) {
    static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
      uint32_t word = 0;
      for (size_t k = 0; k < 3; ++k)
        word = word << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0);
      for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return out;
  }

  // Writes scene.json and its glTF to folder_/NAME; the path as a config names it.
  std::string write_scene(const std::string& name, const Json& scene, const std::string& gltf) const {
    write(name + "/scene.json", scene.dump(2));
    if (!gltf.empty()) write(name + "/square.gltf", gltf);
    return (folder_ / name / "scene.json").string();
  }

  // It obeys the schema, and nothing stands for a number that is none.
  static void expect_sound(const std::filesystem::path& report) {
    const JsonDocument document = JsonDocument::load(report, ErrorKind::output);
    EXPECT_EQ(schema_violations(document.root(), report_schema()), std::vector<std::string>());
    expect_numbers(document.root());
  }
  static void expect_numbers(const Json& value) {
    EXPECT_FALSE(value.is_null());
    EXPECT_TRUE(!value.is_number() || std::isfinite(value.get<double>()));
    if (!value.is_structured()) return;
    for (const auto& item : value) expect_numbers(item);
  }

  std::filesystem::path folder_, out_;
  Json config_;
};

}  // namespace vsglbench
