// shade.comp's closed forms against shaders/shading_exact.h on random inputs.
#include "frame/shade_fixture.h"

using namespace vsglbench;

namespace {

using exact::VsglModel;
using exact::VsglShading;
using glm::dvec3;
constexpr double kPi = 3.14159265358979323846;

template <class Make>
auto some(uint32_t count, const Make& make) {
  std::vector<decltype(make())> out;
  for (uint32_t i = 0; i < count; ++i) out.push_back(make());
  return out;
}

// Variances from far below the squared distance, where the disk is a point, to far above it.
std::vector<gpu::Vsgl> of_every_size(std::vector<gpu::Vsgl> lights) {
  for (size_t i = 0; i < lights.size(); ++i)
    lights[i].variance = std::pow(10.0f, static_cast<float>(i % 18) - 14);
  return lights;
}

TEST_F(ShadeTest, VsglsMatchDouble) {
  const auto lights = some(kLights, [&] { return random_vsgl(); });
  const auto host = [&](const VsglShading& shading) {
    return on_host(lights, [&](const auto& s, const auto& l) { return exact::shade_vsgl(s, l, shading); });
  };
  EXPECT_LT(worst(shade(lights), host({})), 1e-4);
  EXPECT_LT(worst(shade(lights, {{"VARIANCE", "1"}}), host({.disk = true})), 1e-4);
  EXPECT_LT(worst(shade(lights, {{"DIFFUSE_MODEL", "4"}}), host({exact::DiffuseModel::tokuyoshi2024})), 1e-4);
}

TEST_F(ShadeTest, TripleProductsMatchDouble) {
  const auto lights = some(kLights, [&] { return random_vsgl(); });
  for (const auto& set : {lights, of_every_size(lights)}) {
    for (const bool disk : {false, true}) {
      const VsglShading shading{.disk = disk, .model = VsglModel::vsgl14};
      const auto host =
          on_host(set, [&](const auto& s, const auto& l) { return exact::shade_vsgl(s, l, shading); });
      const auto gpu = shade(set, {{"SHADING_MODEL", "1"}, {"VARIANCE", disk ? "1" : "0"}});
      EXPECT_LT(worst(gpu, host), 1e-4);
    }
  }
}

// σ → 0 between diffuse surfaces: Φ Rd/π Rd/π cos cos / d² [VSGL14 Eq. 1], of a light of power ΦRd.
TEST_F(ShadeTest, ADiffuseTripleProductComesToAPointLight) {
  for (auto& s : pixels_) s.f0 = dvec3(0);
  images_[4].upload(std::vector<glm::vec4>(pixels_.size(), glm::vec4(0)).data(),
                    pixels_.size() * sizeof(glm::vec4));
  auto lights = some(kLights, [&] { return random_vsgl(); });
  for (auto& l : lights) {
    l.specular = glm::vec3(0);
    l.variance = 1e-9f;
  }
  const auto point = [&](const exact::Surface& s, const gpu::Vsgl& l) {
    const dvec3 to = dvec3(l.mean) - s.position;
    const double d = glm::length(to);
    const double cosines =
        std::max(glm::dot(to, s.normal), 0.0) * std::max(-glm::dot(to, dvec3(l.diffuse_axis)), 0.0);
    return dvec3(l.diffuse) * exact::sg_integral(l.diffuse_sharpness) / kPi * s.diffuse / kPi * cosines /
           (d * d * d * d);
  };
  const auto expected = on_host(lights, point);
  EXPECT_LT(worst(shade(lights, {{"SHADING_MODEL", "1"}}), expected), 1e-4);
  const VsglShading shading{.model = VsglModel::vsgl14};
  std::vector<glm::vec4> host;
  for (const dvec3& h : on_host(lights, [&](auto&s, auto&l) { return exact::shade_vsgl(s, l, shading); }))
    host.emplace_back(h, 0);
  EXPECT_LT(worst(host, expected), 1e-5);
}

// Lights, the texels that stand for them, and the decisions on the host.
struct Cancelled {
  std::vector<dvec3> radiance;
  std::vector<double> count;
  std::vector<bool> certain;  // no decision that single precision may take the other way
};

TEST_F(ShadeTest, CancelledLightsHaveTheirExactBrdfs) {
  const auto lights = of_every_size(some(200, [&] {
    auto l = random_vsgl();
    if (uniform() < 0.2f) l.specular = glm::vec3(0);
    l.power = uniform() < 0.1f ? 0 : 1;
    return l;
  }));
  const auto texels = some(200, [&] {
    auto t = random_vpl();
    t.power = uniform() < 0.1f ? 0 : 1;
    return t;
  });
  for (const VsglModel model : {VsglModel::vsgl16, VsglModel::vsgl14}) {
    for (const float alpha : {0.001f, 0.1f, 3.0f}) {
      // Half of the variance is for the SGs: the disk that decides and shades a cancelled light keeps all of
      // it.
      const bool disk = model == VsglModel::vsgl16 && alpha == 0.1f;
      const VsglShading shading{.disk = disk, .model = model};
      Cancelled host{std::vector<dvec3>(pixels_.size()), std::vector<double>(pixels_.size()),
                     std::vector<bool>(pixels_.size(), true)};
      double all = 0, certain = 0;
      for (size_t i = 0; i < pixels_.size(); ++i) {
        for (size_t k = 0; k < lights.size(); ++k) {
          const double least = exact::cancelling_alpha(pixels_[i], lights[k]);
          const bool is_cancelled = lights[k].power > 0 && texels[k].power > 0 && double{alpha} > least;
          host.certain[i] = host.certain[i] && std::abs(least / alpha - 1) > 1e-5;
          host.count[i] += is_cancelled;
          host.radiance[i] += is_cancelled ? exact::shade_cancelled(pixels_[i], lights[k], texels[k])
                                           : exact::shade_vsgl(pixels_[i], lights[k], shading);
        }
        all += host.count[i];
      }
      const ShaderDefines defines = {{"SHADING_MODEL", model == VsglModel::vsgl14 ? "1" : "0"},
                                     {"BIAS_REDUCTION", "1"},
                                     {"VARIANCE", disk ? "1" : "0"}};
      auto gpu = shade(lights, defines, {.alpha = alpha}, texels);
      for (size_t i = 0; i < gpu.size(); ++i) {
        if (!host.certain[i]) {
          gpu[i] = glm::vec4(host.radiance[i], host.count[i]);
          continue;
        }
        ++certain;
        EXPECT_EQ(gpu[i].a, host.count[i]) << "pixel " << i << ", alpha " << alpha;
      }
      EXPECT_LT(worst(gpu, host.radiance), 1e-4) << "alpha " << alpha;
      EXPECT_GT(certain, 0.9 * static_cast<double>(gpu.size()));
      const double rate = all / static_cast<double>(gpu.size() * lights.size());
      EXPECT_GT(rate, 0.1) << "alpha " << alpha;
      EXPECT_LT(rate, 0.8) << "alpha " << alpha;
    }
  }
}

// A point light as a filtered one of no extent.
gpu::FilteredLight filtered(const gpu::Vpl& l) {
  return {.mean = l.position,
          .variance = 1e-12f,
          .normal = l.normal,
          .diffuse = l.flux * l.diffuse / float(kPi),
          .ndf = l.ndf,
          .incident = l.incident,
          .flux = l.flux,
          .f0 = l.f0};
}

TEST_F(ShadeTest, FilteredLightsMatchDouble) {
  auto lights = some(100, [&] { return filtered(random_vpl()); });
  for (size_t i = 0; i < lights.size(); ++i)
    lights[i].variance = std::pow(10.0f, static_cast<float>(i % 18) - 14);
  const auto host = on_host(lights, [](const auto& s, const auto& l) { return exact::shade_filtered(s, l); });
  EXPECT_LT(worst(shade(lights, {{"SHADING_MODEL", "2"}, {"LIGHT_FILTERED", "1"}}), host), 1e-4);
}

// σ → 0: the point light itself [VSGL14 Eq. 1].
TEST_F(ShadeTest, AFilteredLightComesToAPointLight) {
  auto points = some(kLights, [&] { return random_vpl(); });
  std::vector<gpu::FilteredLight> lights;
  for (gpu::Vpl& p : points) {
    p.geometric_normal = p.normal;
    lights.push_back(filtered(p));
  }
  const auto host = on_host(points, [](const auto& s, const auto& l) { return exact::shade_vpl(s, l); });
  EXPECT_LT(worst(shade(lights, {{"SHADING_MODEL", "2"}, {"LIGHT_FILTERED", "1"}}), host), 1e-4);
}

TEST_F(ShadeTest, VplsMatchDouble) {
  const auto lights = some(kLights, [&] { return random_vpl(); });
  const auto host = on_host(lights, [&](const auto& s, const auto& l) { return exact::shade_vpl(s, l); });
  EXPECT_LT(worst(shade(lights), host), 1e-4);
}

TEST_F(ShadeTest, ALightWithoutPowerAddsNothing) {
  for (const char* model : {"0", "1"}) {
    for (const auto& p : shade(std::vector<gpu::Vsgl>(3), {{"SHADING_MODEL", model}}))
      EXPECT_EQ(glm::vec3(p), glm::vec3(0));
  }
}

}  // namespace
