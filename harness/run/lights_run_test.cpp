// Lights of whole frames, without a process of their own.
#include "run/lights_run.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/file.h"
#include "method/registry.h"
#include "run/scene_pdfs.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

Device& device() {
  static Device d;
  return d;
}

FrameParameters small() {
  return {.width = 96,
          .height = 54,
          .rsm = 128,
          .lights = 128,
          .importance_lights = 256,
          .visibility = Visibility::none};
}

class LightsRunTest : public ::testing::TestWithParam<const char*> {
 protected:
  LightsRunTest()
      : scene_(load_scene(GetParam(), {data_root() / "scenes", {}})),
        kernels_(device()),
        stage_(device(), kernels_, scene_) {}
  Frame frame(const std::string& method) {
    const MethodInfo& info = load_method(method, device().info());
    return Frame(stage_, info, resolve_parameters(info, Json::object()), small(), nullptr);
  }
  static Coverage coverage(Frame& f, uint32_t seed, ScenePdfs* shared) {
    const LightSet set = make_lights(f, seed, shared, small());
    EXPECT_GT(set.count(), set.empty()) << "no light";
    return coverage_of(set.shapes, set.count(), set.rsm, set.rsm, set.pdf).value();
  }

  Scene scene_;
  KernelLibrary kernels_;
  Stage stage_;
};

// [MFIS16 Fig. 1], where there is anything to be lit: weighted by the PDF, which both methods share here. In
// the mean over lattices: with so few lights some single ones on ring514 go the other way.
TEST_P(LightsRunTest, MfisOverlapsAndLeavesLessThanFis) {
  constexpr uint32_t kSeeds = 8;
  ScenePdfs pdfs(stage_);
  const auto mean_misses = [&](const std::string& method) {
    Frame f = frame(method);
    double sum = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
      const Coverage c = coverage(f, seed, &pdfs);
      sum += *c.pdf_overlap + *c.pdf_gap;
    }
    return sum / kSeeds;
  };
  const double fis = mean_misses("fis"), mfis = mean_misses("mfis");
  EXPECT_LT(mfis, fis);
  EXPECT_GT(mfis, 0.1) << "squares can't tile this well";
  RecordProperty("fis", fmt::format("{:.4f}", fis));
  RecordProperty("mfis", fmt::format("{:.4f}", mfis));
}

// Every texel that reflects is in one cluster.
TEST_P(LightsRunTest, APartitionLeavesNothingThatThePdfWants) {
  Frame f = frame("kmeans2d");
  const Coverage c = coverage(f, 0, nullptr);
  EXPECT_EQ(c.overlap, 0);
  EXPECT_EQ(*c.pdf_gap, 0);
  EXPECT_LT(c.gap, 1);
}

// What is drawn is what a frame is shaded with.
TEST_P(LightsRunTest, LightsAreThoseOfTheFrame) {
  for (const char* method : {"mfis", "mfis-mh", "vpl", "two-vsgl"}) {
    Frame f = frame(method);
    const LightSet set = make_lights(f, 3, nullptr, small());
    f.render(3);
    EXPECT_TRUE(f.results().lights() == set.lights) << method;
    EXPECT_EQ(set.pdf, f.results().importance()) << method;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightsRunTest, ::testing::Values("cornell", "ring514", "colonnade"));

}  // namespace
}  // namespace vsglbench
