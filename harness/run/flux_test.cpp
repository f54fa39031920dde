// Σ light power / Σ texel power of whole frames.
#include <gtest/gtest.h>

#include "measure/statistics.h"
#include "run/laboratory.h"

namespace vsglbench {
namespace {

// The flux of `seeds` frames without visibility.
std::vector<double> flux(const std::string& scene, const std::string& method, const Json& own,
                         Importance importance, uint32_t seeds) {
  Laboratory lab(scene);
  const MethodInfo& info = load_method(method, Laboratory::device().info());
  Frame frame(lab.stage, info, resolve_parameters(info, own),
              {.width = 96,
               .height = 54,
               .rsm = 64,
               .lights = 256,
               .importance_lights = 256,
               .visibility = Visibility::none,
               .importance = importance},
              nullptr);
  std::vector<double> ratios;
  for (uint32_t seed = 0; seed < seeds; ++seed) {
    frame.render(seed, true);
    EXPECT_EQ(frame.memory_fault(), "");
    ratios.push_back(frame.results().light_power() / frame.results().texel_power());
  }
  return ratios;
}

TEST(Flux, AllTexelsCarryWhatTheyReflect) {
  for (const char* scene : {"cornell", "ring514", "colonnade"}) {
    for (const char* shading : {"vsgl16", "exact"})
      EXPECT_NEAR(flux(scene, "all-texels", {{"shading", shading}}, Importance::own, 1)[0], 1, 1e-5)
          << scene << shading;
  }
}

// Drawn in proportion to what it reflects, each texel stands for the same power.
TEST(Flux, LightsDrawnByReflectedPowerKeepItInEverySet) {
  for (const char* method : {"vpl", "mfis"}) {
    for (const double r : flux("cornell", method, Json::object(), Importance::flux, 4))
      EXPECT_NEAR(r, 1, 1e-3) << method;
  }
}

TEST(Flux, DrawnTexelsKeepItInTheMean) {
  const auto mean = mean_ci95(flux("cornell", "vpl", Json::object(), Importance::own, 32));
  EXPECT_NEAR(mean.mean, 1, 1.5 * mean.ci95.width() / 2);
  EXPECT_LT(mean.ci95.width(), 0.1);
}

// Where p is uneven, E[Σ] = ∫ f̄ p/p̄ is below ∫ f [MFIS16 Eq. 5].
TEST(Flux, MfisLosesItWhereThePdfIsUneven) {
  const auto mean = mean_ci95(flux("ring514", "mfis", Json::object(), Importance::own, 8));
  EXPECT_LT(mean.ci95.hi, 0.9);
  EXPECT_GT(mean.ci95.lo, 0.2);
}

}  // namespace
}  // namespace vsglbench
