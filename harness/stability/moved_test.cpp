// A scene's image does not depend on where it stands.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.h"
#include "base/json.h"
#include "frame/frame.h"
#include "image/metrics.h"
#include "method/registry.h"
#include "scene/scene_file.h"

using namespace vsglbench;

namespace {

Scene moved(const std::string& name, double units) {
  Json json = JsonDocument::load(data_root() / "scenes" / name / "scene.json", ErrorKind::scene).root();
  json["offset"] = {units, units, units};
  const auto file = std::filesystem::path(testing::TempDir()) / ("moved-" + name + ".json");
  write_text(file, json.dump());
  return load_scene(file.string(), {data_root() / "scenes", {}});
}

struct Picture {
  Image image;
  std::vector<uint8_t> mask;
};

Picture render(Device& device, const Scene& scene, const std::string& method) {
  KernelLibrary kernels(device);
  Stage stage(device, kernels, scene);
  const MethodInfo& info = load_method(method, device.info());
  const FrameParameters p{.width = 120,
                          .height = 68,
                          .rsm = 64,
                          .lights = 64,
                          .importance_lights = 256,
                          .visibility = Visibility::none};
  Frame frame(stage, info, resolve_parameters(info, Json::object()), p, nullptr);
  frame.render(0);
  return {frame.results().indirect(), frame.results().surface_mask()};
}

}  // namespace

TEST(Moving, AnySceneBy1e5UnitsLeavesItsImage) {
  Device device;
  for (const char* name : {"cornell", "ring514", "colonnade"}) {
    const Scene here = moved(name, 0), there = moved(name, 1e5);
    EXPECT_LT(glm::length(there.origin - here.origin - glm::dvec3(1e5)), 1e-9) << name;
    for (const char* method : {"mfis", "kmeans2d-segmented", "vpl"}) {
      const Picture a = render(device, here, method), b = render(device, there, method);
      const double smape = measure_errors(b.image, a.image, a.mask).smape;
      fmt::print("{:<10} {:<19} SMAPE {:.5f} %\n", name, method, smape);
      EXPECT_LT(smape, 0.1) << name << " " << method;
    }
  }
}

// Were positions single precision in the world, this would be their error.
TEST(Moving, PositionsKeepTheirDigits) {
  const Scene here = moved("cornell", 0), there = moved("cornell", 1e5);
  ASSERT_EQ(here.positions.size(), there.positions.size());
  for (size_t i = 0; i < here.positions.size(); ++i) {
    EXPECT_LT(glm::length(here.positions[i] - there.positions[i]), 1e-6f);
  }
  EXPECT_LT(glm::length(here.light.position - there.light.position), 1e-6f);
  EXPECT_LT(glm::length(here.camera.position - there.camera.position), 1e-6f);
}
