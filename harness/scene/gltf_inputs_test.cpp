// Files that other people's exporters write, where they are on this machine; builders of each kind of fault
// stand in the tests beside this one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "scene/scene_file.h"

namespace vsglbench {
namespace {

std::filesystem::path inputs() {
  const char* assets = std::getenv("VSGLBENCH_ASSETS");
  return std::filesystem::path(assets ? assets : "") / ".." / "inputs" / "gltf";
}

Scene load(const std::string& folder) { return load_scene((inputs() / folder / "scene.json").string(), {}); }

std::string all(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += line + " | ";
  return out;
}

class GltfInputs : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(inputs() / "00-good")) GTEST_SKIP() << "not on this machine";
  }
};

TEST_F(GltfInputs, AllButADamagedImageLoadLikeTheGoodOne) {
  const Scene good = load("00-good");
  for (const char* folder :
       {"01-skin-without-inverseBindMatrices", "02-animation-target-without-node",
        "03-bin-longer-than-byteLength", "04-one-NaN-normal", "07-KHR_lights_punctual-required",
        "08-texture-without-source", "12-skinned-mesh-displaced", "13-gltfpack-uvs"}) {
    const Scene scene = load(folder);
    EXPECT_EQ(scene.positions, good.positions) << folder;
    EXPECT_EQ(scene.origin, good.origin) << folder;
    EXPECT_EQ(scene.normals, good.normals) << folder;
  }
  EXPECT_NE(all(load("04-one-NaN-normal").warnings).find("1 normals"), std::string::npos);
}

TEST_F(GltfInputs, ADamagedImageIsOneShortLine) {
  try {
    load("09-data-image-jpg");
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_LT(std::string(e.what()).size(), 300u) << e.what();
    EXPECT_NE(std::string(e.what()).find("is not an image"), std::string::npos) << e.what();
  }
}

TEST_F(GltfInputs, CoordinatesOfGltfpackAreThoseItWasGiven) {
  const Scene scene = load("13-gltfpack-uvs"), expected = load("13-gltfpack-uvs/expected");
  ASSERT_EQ(scene.uvs.size(), expected.uvs.size());
  for (size_t i = 0; i < scene.uvs.size(); ++i)
    EXPECT_LT(glm::length(scene.uvs[i] - expected.uvs[i]), 1e-6f) << i;
}

}  // namespace
}  // namespace vsglbench
