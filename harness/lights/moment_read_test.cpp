// The mipmapped RSM as the device has it against means over texels in double (method/oracle.h).
#include <algorithm>

#include "lights/moment_pictures.h"
#include "method/test_field.h"

namespace vsglbench {
namespace {

// The pyramid that filtered sampling builds from a made-up half, read back.
class MomentRead : public ::testing::Test {
 protected:
  std::optional<MipmappedRsm> read(const oracle::Half& half, unsigned lobes = DIFFUSE_LOBE | SPECULAR_LOBE) {
    KernelLibrary kernels(test_device());
    ScratchPool scratch(test_device());
    Recorder recorder(test_device());
    MethodContext context(kernels, scratch, {}, {{"LIGHT_LOBES", std::to_string(lobes)}}, lobes);
    const DeviceHalf on_device(test_device(), half);
    MomentPyramid pyramid(context);
    recorder.begin();
    Steps steps(recorder, Half::rsm);
    pyramid.build(steps, on_device.field(Half::rsm));
    recorder.submit_and_wait();
    return read_mipmapped_rsm(context, half.emitter.width, half.emitter.height);
  }
};

double distance(const glm::vec3& a, const glm::dvec3& b) { return glm::length(glm::dvec3(a) - b); }

// Against sums over the base texels of a block, which the test takes itself.
void expect_means(const oracle::Half& half, const MipmappedRsm& rsm) {
  const uint32_t w = half.emitter.width, h = half.emitter.height;
  uint32_t block = 1;
  for (const MomentLevel& level : rsm.levels) {
    ASSERT_EQ(level.width, (w + block - 1) / block);
    ASSERT_EQ(level.height, (h + block - 1) / block);
    ASSERT_EQ(level.texels.size(), size_t(level.width) * level.height);
    for (uint32_t i = 0; i < level.texels.size(); ++i) {
      oracle::Sums sums;
      double texels = 0;
      for (uint32_t y = i / level.width * block; y < std::min(h, (i / level.width + 1) * block); ++y) {
        for (uint32_t x = i % level.width * block; x < std::min(w, (i % level.width + 1) * block);
             ++x, ++texels)
          sums.add(oracle::texel_sums(half, x, y), 1);
      }
      SCOPED_TRACE(fmt::format("{}×{}, block {}, texel {}", w, h, block, i));
      const MomentTexel& t = level.texels[i];
      const double diffuse = oracle::luminance(sums.diffuse), specular = oracle::luminance(sums.specular),
                   all = diffuse + specular;
      if (!(all > 0)) {
        EXPECT_EQ(t.diffuse + t.specular, glm::vec3(0));
        EXPECT_EQ(t.position, glm::vec3(0));
        EXPECT_EQ(t.square, 0);
        continue;
      }
      EXPECT_LT(distance(t.diffuse, sums.diffuse / texels), 1e-5 * glm::length(sums.diffuse / texels));
      EXPECT_LT(distance(t.specular, sums.specular / texels), 1e-5 * glm::length(sums.specular / texels));
      EXPECT_LT(distance(t.diffuse_direction, sums.diffuse_direction / diffuse), 1e-5);
      EXPECT_LT(distance(t.specular_direction, sums.specular_direction / specular), 1e-5);
      EXPECT_LT(distance(t.position, sums.position / all), 1e-5);
      EXPECT_NEAR(t.square, sums.square / all, 1e-5 * sums.square / all);
    }
    block *= 2;
  }
  EXPECT_EQ(rsm.levels.back().texels.size(), 1u);
}

TEST_F(MomentRead, EachLevelHoldsTheWeightedMeansOfItsTexels) {
  for (const glm::uvec2 size :
       {glm::uvec2(32, 32), glm::uvec2(61, 35), glm::uvec2(7, 5), glm::uvec2(9, 1), glm::uvec2(1, 1)}) {
    const oracle::Half half = random_half(size.x, size.y, 11);
    const auto rsm = read(half);
    ASSERT_TRUE(rsm);
    EXPECT_EQ(rsm->lobes, unsigned(DIFFUSE_LOBE | SPECULAR_LOBE));
    expect_means(half, *rsm);
  }
}

// Each coarser level has the one texel that covers it, with its own place and directions; all others nothing.
TEST_F(MomentRead, OneLitTexelIsOneOnEveryLevel) {
  oracle::Half half = random_half(13, 11, 3);
  const glm::uvec2 lit(9, 6);
  for (uint32_t i = 0; i < half.texels.size(); ++i)
    half.texels[i].surface = i == lit.y * half.emitter.width + lit.x;
  const auto rsm = read(half);
  ASSERT_TRUE(rsm);
  expect_means(half, *rsm);
  const MomentTexel& base = rsm->levels[0].texels[lit.y * 13 + lit.x];
  ASSERT_GT(luminance(base.diffuse), 0);
  for (uint32_t l = 0; l < rsm->levels.size(); ++l) {
    const MomentLevel& level = rsm->levels[l];
    EXPECT_EQ(std::ranges::count_if(level.texels, [](const auto& t) { return luminance(t.diffuse) > 0; }), 1);
    const MomentTexel& t = level.texels[(lit.y >> l) * level.width + (lit.x >> l)];
    EXPECT_LT(distance(t.position, base.position), 1e-6) << l;
    EXPECT_LT(distance(t.specular_direction, base.specular_direction), 1e-6) << l;
  }
}

TEST_F(MomentRead, ALobeThatLightsDoNotHaveIsBlack) {
  const auto rsm = read(random_half(8, 8, 1), DIFFUSE_LOBE);
  ASSERT_TRUE(rsm);
  EXPECT_EQ(rsm->lobes, unsigned(DIFFUSE_LOBE));
  EXPECT_GT(luminance(rsm->levels.back().texels[0].diffuse), 0);
  EXPECT_EQ(rsm->levels.back().texels[0].specular, glm::vec3(0));
}

TEST_F(MomentRead, AMethodThatFiltersNothingHasNone) {
  KernelLibrary kernels(test_device());
  ScratchPool scratch(test_device());
  const MethodContext context(kernels, scratch, {});
  EXPECT_FALSE(read_mipmapped_rsm(context, 8, 8).has_value());
}

}  // namespace
}  // namespace vsglbench
