// Shadow maps against exact visibility: the same lights shaded alike, only what hides them differs.
#include <gtest/gtest.h>

#include "run/laboratory.h"

using namespace vsglbench;

namespace {

constexpr uint32_t kLights = 64;

// One scene's frames with shadow maps, and the same with exact visibility.
class Comparison {
 public:
  explicit Comparison(const std::string& scene, const std::string& method = "mfis",
                      const std::string& clearance = "0")
      : lab_(scene), method_(method), clearance_(clearance), exact_(render(Visibility::exact, {})) {}

  double smape(Visibility technique, const IsmParameters& ism = {}) {
    const Errors e = measure_errors(render(technique, ism), exact_, lab_.mask);
    std::printf("%s %s %s %u² %u: SMAPE %.2f %%, bias %+.2f %%\n", lab_.scene.name.c_str(), method_.c_str(),
                visibility_name(technique).c_str(), ism.size, ism.points, e.smape, 100 * *e.bias);
    return e.smape;
  }

  size_t memory(Visibility technique, const IsmParameters& ism = {}) {
    return lab_.stage.shadow_maps(technique, ism).memory_bytes(kLights);
  }

 private:
  Image render(Visibility visibility, const IsmParameters& ism) {
    const Image image = lab_.render(method_, Json::object(),
                                    {.rsm = 64,
                                     .lights = kLights,
                                     .visibility = visibility,
                                     .ism = ism,
                                     .shading = {{"light_clearance", clearance_}}});
    const Health health = check_health(image);
    EXPECT_TRUE(health.finite() && health.negative == 0);
    return image;
  }
  Laboratory lab_;
  const std::string method_, clearance_;
  const Image exact_;
};

}  // namespace

class ShadowMapError : public ::testing::TestWithParam<const char*> {};

// View-adaptive points are nearer to exact visibility than as many that know nothing of light and view; and
// so are tessellated triangles, in less memory.
TEST_P(ShadowMapError, FallsFromRandomPointsToChosenOnes) {
  Comparison scene(GetParam());
  const double ism = scene.smape(Visibility::ism);
  EXPECT_LT(scene.smape(Visibility::aism), 0.9 * ism);
  EXPECT_LT(scene.smape(Visibility::tism), 0.9 * ism);
  EXPECT_LT(scene.memory(Visibility::tism), 0.5 * scene.memory(Visibility::ism));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowMapError, ::testing::Values("cornell", "ring514", "colonnade"));

// More texels and points come nearer to the truth; without any test at all it is far. What is tested is what
// stands between a light and a pixel: with `light_clearance` 0, where the mean of a curved cluster lies just
// below the surface that it is of, no map is fine enough to find that out for every pixel. Points that know
// nothing of the light (ism) do not: those near it stay few.
TEST(ShadowMaps, ApproachExactVisibility) {
  Comparison cornell("cornell", "mfis", "sigma");
  const double none = cornell.smape(Visibility::none);
  for (const Visibility technique : {Visibility::aism, Visibility::tism}) {
    const double coarse = cornell.smape(technique, {.size = 32, .points = 2048}),
                 fine = cornell.smape(technique, {.size = 128, .points = 32768});
    EXPECT_LT(fine, 0.7 * coarse);
    EXPECT_LT(fine, 0.25 * none);
  }
}

// VPLs have hemispheres for maps.
TEST(ShadowMaps, OfVplsAgreeWithExactVisibility) {
  Comparison cornell("cornell", "vpl");
  const double none = cornell.smape(Visibility::none);
  for (const Visibility technique : {Visibility::ism, Visibility::aism, Visibility::tism})
    EXPECT_LT(cornell.smape(technique), 0.5 * none);
}
