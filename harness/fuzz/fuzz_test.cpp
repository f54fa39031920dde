// Sound files are read, and damaged ones read or refused. With $VSGLBENCH_FUZZ_SEEDS, the sound ones are
// written to that folder, as seeds of ci/fuzz.

#include <random>

#include "base/file.h"
#include "base/hash.h"
#include "fuzz/input.h"
#include "fuzz/targets.h"
#include "gpu/spirv_cache.h"
#include "image/exr.h"
#include "operation/sg_random.h"
#include "scene/gltf_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

using fuzz::Bytes;

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

class Fuzz : public GltfFixture {
 protected:
  // `seed` is read; with bytes changed or cut off it is read or refused.
  void expect_survives(std::string_view target, const std::string& seed) {
    const auto all = fuzz::targets();
    const auto found = std::ranges::find(all, target, &fuzz::Target::name);
    ASSERT_NE(found, all.end());
    if (const char* to = std::getenv("VSGLBENCH_FUZZ_SEEDS"))
      write_text(fs::path(to) / target / Hasher().text(seed).hex(), seed);
    EXPECT_TRUE(found->read(bytes_of(seed))) << target << ": " << seed.substr(0, 1000);
    for (int k = 0; k < kDamaged; ++k) {
      const std::string bytes = damaged(seed);
      EXPECT_NO_THROW(found->read(bytes_of(bytes))) << target << ": " << bytes.substr(0, 1000);
    }
  }

  void add_texture() {
    json_["images"] = {{{"uri", std::string("data:image/png;base64,") + kPngBase64}}};
    json_["textures"] = {{{"source", 0}}};
    const Json texture = {{"index", 0}};
    json_["materials"] = {
        {{"name", "paint"},
         {"alphaMode", "MASK"},
         {"normalTexture", texture},
         {"pbrMetallicRoughness", {{"baseColorTexture", texture}, {"metallicRoughnessTexture", texture}}}}};
    primitive()["material"] = 0;
  }

 private:
  static constexpr int kDamaged = 40;

  std::string damaged(std::string bytes) {
    if (random_() % 8 == 0) bytes.resize(random_() % bytes.size());
    for (int n = static_cast<int>(random_() % 4); n >= 0 && !bytes.empty(); --n)
      bytes[random_() % bytes.size()] = static_cast<char>(random_());
    return bytes;
  }

  std::mt19937 random_{1};
};

TEST_F(Fuzz, Gltf) {
  add_square();
  expect_survives("gltf", glb_bytes());
  json_["nodes"] = Json::parse(R"([{"translation": [10, 0, 0], "children": [1, 2]},
    {"rotation": [0, 0, 0.6, 0.8], "scale": [2, -1, 1], "mesh": 0},
    {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1], "mesh": 0}])");
  add_texture();
  expect_survives("gltf", glb_bytes());
  primitive().erase("indices");
  primitive()["mode"] = 5;
  primitive()["attributes"].erase("NORMAL");
  expect_survives("gltf", glb_bytes());
}

TEST_F(Fuzz, Scene) {
  const auto view =
      Json::parse(R"({"front": {"description": "", "camera": {"eye": [0, 0, 4], "direction": [0, 0, -1],
    "vfov": 40, "up": [0, 1, 0]}, "light": {"spot": {"position": [1, 1, 3], "target": [0, 0, 0], "fov": 40,
    "intensity": [5, 4, 3]}}}, "sun": {"description": "", "camera": {"eye": [0, 0, 4], "target": [0, 0, 0], "vfov": 40},
    "light": {"sun": {"direction": [0, -1, -1], "irradiance": 3, "centre": [0, 1, 1], "half_extent": [2, 2]}}}})");
  Json scene = {{"name", "triangle"},
                {"description", "one triangle"},
                {"geometry", {{"file", "triangle.gltf"}}},
                {"unit", 0.01},
                {"view_unit", 1},
                {"offset", {1, 2, 3}},
                {"default_view", "sun"},
                {"views", view}};
  scene["materials"] = Json::parse(R"([{"match": "p*", "base_color": [0.5, 0.4, 0.3], "metallic": 0.5,
    "roughness": 0.3, "phong_exponent": 100, "specular": 0.5}])");
  expect_survives("scene", scene.dump());
  for (const char* key : {"unit", "view_unit", "materials"}) scene.erase(key);
  scene["geometry"] = {{"builder", "ring514"}};
  expect_survives("scene", scene.dump());
  scene["geometry"] = {{"builder", "cornell"}};
  expect_survives("scene", scene.dump());
}

TEST_F(Fuzz, Config) {
  const fs::path configs = fs::path(VSGLBENCH_SOURCE_DIR) / "configs";
  for (const char* name : {"quick", "views", "visibility", "mfis16-table1"})
    expect_survives("config", read_text(configs / (std::string(name) + ".json")));
  const std::string with_preset =
      R"({"name": "p", "preset": "p", "scenes": ["cornell"], "methods": [{"method": "fis", "preset": "p"}]})";
  for (const char* name : {"author2024", "papers/mfis16", "papers/vsgl14"}) {
    const std::string preset = read_text(configs / "presets" / (std::string(name) + ".json"));
    expect_survives("config", preset + '\0' + with_preset);
  }
}

TEST_F(Fuzz, Exr) {
  ExrLayers layers;
  layers.width = fuzz::kReferenceWidth;
  layers.height = fuzz::kReferenceHeight;
  layers.scalars["Z"].assign(size_t{layers.width} * layers.height, 0.25f);
  layers.attributes["note"] = "text";
  write_exr(folder_ / "a.exr", layers);
  expect_survives("exr", read_text(folder_ / "a.exr"));
  for (const char* name : {"", "variance", "half0"}) layers.colors[name] = Image(layers.width, layers.height);
  write_exr(folder_ / "a.exr", layers);
  expect_survives("exr", read_text(folder_ / "a.exr"));
}

TEST_F(Fuzz, ReferenceCache) {
  ExrLayers layers;
  layers.width = fuzz::kReferenceWidth;
  layers.height = fuzz::kReferenceHeight;
  Hasher images;
  for (const char* name : {"", "variance", "half0", "half1"})
    images.array((layers.colors[name] = Image(layers.width, layers.height)).pixels);
  const size_t count = size_t{layers.width} * layers.height;
  layers.scalars["mask"].assign(count, 1);
  images.array(std::vector<uint8_t>(count, 1));
  write_exr(folder_ / "a.exr", layers);
  const Json meta = {{"hash", fuzz::kReferenceHash},
                     {"images", images.hex()},
                     {"samples", 4},
                     {"batches", 2},
                     {"photons", 1},
                     {"rays", 9},
                     {"seconds", 0.5},
                     {"standard_error", 0.25},
                     {"ended_by", 0}};
  expect_survives("reference_cache", fuzz::pack_reference(meta.dump(), read_text(folder_ / "a.exr")));
}

TEST_F(Fuzz, SpirvCache) {
  write_cached_spirv(folder_ / "a.spv", {0x07230203, 0x00010600, 0, 1, 0});
  expect_survives("spirv_cache", read_text(folder_ / "a.spv"));
}

TEST_F(Fuzz, SgRows) {
  for (size_t k = 0; k < sg_functions().size(); ++k) {
    const SgQuestion question{static_cast<SgFunction>(k)};
    const auto& columns = question.info().columns;
    const std::vector<float> rows = random_rows(question, 3, 1);
    std::string text{static_cast<char>(k), '\0'};
    text += fmt::format("{}", fmt::join(columns, ","));
    for (size_t i = 0; i < rows.size(); ++i)
      text += fmt::format("{}{}", i % columns.size() ? "," : "\n", rows[i]);
    expect_survives("sg_rows", text + "\r\n");
  }
}

}  // namespace
}  // namespace vsglbench
