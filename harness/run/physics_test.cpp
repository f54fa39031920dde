// Physics across rooms: the rasteriser against rays, brute force against the reference, clustering against
// brute force. Small frames; RSMs of 32² to 128².
#include <gtest/gtest.h>

#include <random>

#include "reference/brdf.h"
#include "run/laboratory.h"
#include "scene/surface.h"
#include "shaders/shading_exact.h"
#include "stability/planted_tree.h"

using namespace vsglbench;

namespace {

constexpr uint32_t kWidth = Laboratory::kWidth, kHeight = Laboratory::kHeight;

Laboratory& cornell() {
  static Laboratory lab("cornell");
  return lab;
}

}  // namespace

// all-texels with exact BRDFs: only the RSM's resolution stands between it and the truth.
class BruteForce : public ::testing::TestWithParam<Visibility> {};

TEST_P(BruteForce, ConvergesToTheReference) {
  Laboratory& lab = cornell();
  double previous = 1e9;
  for (const uint32_t rsm : {32u, 64u, 128u}) {
    const Image image = lab.render("all-texels", {{"shading", "exact"}}, rsm, 0, GetParam());
    const Errors e = lab.against_reference(image, GetParam() == Visibility::exact);
    std::printf("rsm %u: SMAPE %.3f %%, bias %+.3f %%\n", rsm, e.smape, 100 * *e.bias);
    EXPECT_LT(e.smape, previous) << "the error must fall as the RSM grows to " << rsm;
    previous = e.smape;
    if (rsm == 128) {
      EXPECT_LT(std::abs(*e.bias), 0.01);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Visibility, BruteForce, ::testing::Values(Visibility::exact, Visibility::none));

// With N up to the number of texels, mfis comes to what all texels give with the same SG lobes.
TEST(Clustering, ConvergesToBruteForceWithTheSameLobes) {
  Laboratory& lab = cornell();
  const Image brute = lab.render("all-texels", {{"shading", "vsgl16"}}, 64, 0, Visibility::none);
  double previous = 1e9;
  for (const uint32_t lights : {16u, 64u, 256u, 1024u, 4096u}) {
    const Image image = lab.render("mfis", Json::object(), 64, lights, Visibility::none);
    const Errors e = measure_errors(image, brute, lab.mask);
    std::printf("N %u: SMAPE %.3f %%, bias %+.3f %%\n", lights, e.smape, 100 * *e.bias);
    EXPECT_LT(e.smape, previous) << "N = " << lights;
    previous = e.smape;
  }
  EXPECT_LT(previous, 1.0);
}

// The G-buffer holds what rays through the pixel centres hit, textures and normal maps included; triangle
// edges that fall on the other side of a pixel centre are the only difference.
TEST(Rasteriser, SeesWhatRaysSee) {
  Laboratory lab("colonnade");
  lab.render("vpl", Json::object(), 64, 1, Visibility::none);
  const DeferredTargets& g = lab.stage.targets(Half::gbuffer, kWidth, kHeight);
  const auto position = download_map(g.maps[0]), normal = download_map(g.maps[1]),
             geometric = download_map(g.maps[2]), diffuse = download_map(g.maps[3]),
             f0 = download_map(g.maps[4]);
  const View view = camera_view(lab.scene.camera, kWidth, kHeight);
  size_t different = 0, compared = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      glm::vec3 origin, direction;
      view.ray({(x + 0.5f) / kWidth, (y + 0.5f) / kHeight}, &origin, &direction);
      const auto hit = lab.tracer.intersect(origin, direction);
      const size_t i = size_t(y) * kWidth + x;
      if (!hit || !(position[i].w > 0)) {
        different += hit.has_value() != (position[i].w > 0);
        continue;
      }
      ++compared;
      const Surface s = surface_at(lab.scene, hit->triangle, hit->barycentric, -direction);
      const float distance = glm::length(s.position - origin);
      // 8-bit texture filtering weights allow 1/256 of a texel's step in colour and normal.
      const bool same = glm::length(glm::vec3(position[i]) - s.position) < 1e-3f * distance &&
                        glm::length(glm::vec3(geometric[i]) - s.geometric_normal) < 1e-3f &&
                        glm::length(glm::vec3(normal[i]) - s.normal) < 0.03f &&
                        glm::length(glm::vec3(diffuse[i]) - s.diffuse) < 0.02f &&
                        glm::length(glm::vec3(f0[i]) - s.f0) < 0.02f &&
                        std::abs(normal[i].w - s.ndf) < 1e-3f * std::abs(s.ndf);
      different += !same;
    }
  }
  std::printf("%zu of %zu pixels differ\n", different, compared);
  EXPECT_GT(compared, kWidth * kHeight / 2);
  EXPECT_LT(static_cast<double>(different), 0.01 * kWidth * kHeight);
}

// What SG shading costs by itself: every texel a light, by its lobes and by its exact BRDF, without
// visibility.
namespace {

Errors of_lobes(Laboratory& lab, const char* shading) {
  const Image exact = lab.render("all-texels", {{"shading", "exact"}}, 64, 0, Visibility::none);
  FrameParameters p{.rsm = 64, .visibility = Visibility::none};
  p.shading = {{"shading", shading}};
  const Errors e = measure_errors(lab.render("all-texels", {{"shading", shading}}, p), exact, lab.mask);
  std::printf("%s, %s: SMAPE %.2f %%, rRMSE %.3f, bias %+.2f %%\n", lab.scene.name.c_str(), shading, e.smape,
              *e.rrmse, 100 * *e.bias);
  return e;
}

}  // namespace

TEST(Lobes, OfAGlossyRoomHaveTheTabledErrors) {
  Laboratory glossy("cornell-glossy");
  const Errors vsgl16 = of_lobes(glossy, "vsgl16"), vsgl14 = of_lobes(glossy, "vsgl14");
  EXPECT_NEAR(*vsgl16.rrmse, 0.344, 0.01);
  EXPECT_NEAR(*vsgl16.bias, -0.0757, 0.003);
  EXPECT_NEAR(*vsgl14.rrmse, 0.307, 0.01);
  EXPECT_NEAR(*vsgl14.bias, -0.0367, 0.003);
  // The receiver's lobe turned by 90 degrees.
  const PlantedTree tree;
  tree.edit_shaders([](std::string text) {
    const std::string peak = "r.peak = ndf_peak(s.ndf);";
    const size_t at = text.find(peak);
    return at == std::string::npos
               ? text
               : text.replace(at, peak.size(),
                              peak + " float eta = r.eta_x; r.eta_x = r.eta_y; r.eta_y = eta;");
  });
  Laboratory turned("cornell-glossy");
  EXPECT_GT(*of_lobes(turned, "vsgl16").rrmse, 2 * *vsgl16.rrmse);
  EXPECT_GT(*of_lobes(turned, "vsgl14").rrmse, 2 * *vsgl14.rrmse);
}

// The BRDF of the oracles and that of the reference were written apart.
TEST(Brdfs, OfOraclesAndReferenceAgree) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto vector = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  const auto direction = [&] { return glm::normalize(2.0f * vector() - 1.0f); };
  int lit = 0;
  for (int i = 0; i < 20000; ++i) {
    Surface s;
    s.normal = direction();
    s.geometric_normal = glm::normalize(s.normal + 0.3f * direction());
    s.diffuse = vector();
    s.f0 = vector();
    s.ndf = uniform(random) < 0.5f ? 0.05f + 0.95f * uniform(random) : -std::exp(7 * uniform(random));
    const glm::vec3 view = glm::normalize(s.normal + 0.95f * direction()), l = direction();
    const exact::Surface e{glm::dvec3(0), s.normal, s.geometric_normal, view, s.diffuse, s.f0, s.ndf};
    const double expected = exact::brdf_cosine(e, l).x, value = Brdf(s, view).f(l).x * glm::dot(s.normal, l);
    if (expected == 0) continue;
    ++lit;
    ASSERT_NEAR(value / expected, 1, 1e-3) << i << " ndf " << s.ndf;
  }
  EXPECT_GT(lit, 5000);
}
