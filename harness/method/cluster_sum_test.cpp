// Both variants of the cluster sums against double-precision sums of the paper's own moments (oracle.h).
#include "method/cluster_sum.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

#include "method/test_field.h"

using namespace vsglbench;

namespace {

using Ids = std::vector<uint32_t>;
using Lights = std::vector<gpu::Vsgl>;

// A half on the device, and its texels' sums in double precision.
class SumBench {
 public:
  explicit SumBench(oracle::Half half)
      : half_(std::move(half)),
        kernels_(test_device()),
        scratch_(test_device()),
        context_(kernels_, scratch_, {}),
        recorder_(test_device()) {
    const uint32_t w = half_.emitter.width, h = half_.emitter.height;
    std::array<std::vector<glm::vec4>, 5> maps;
    for (const auto& t : half_.texels) {
      maps[0].emplace_back(t.position, t.surface ? 1 : 0);
      maps[1].emplace_back(t.normal, t.ndf);
      maps[2].emplace_back(t.geometric_normal, 0);
      maps[3].emplace_back(t.diffuse, 0);
      maps[4].emplace_back(t.f0, 0);
    }
    field_.emitter = half_.emitter;
    for (size_t i = 0; i < maps.size(); ++i) {
      images_[i] = DeviceImage(test_device(), "map", VK_FORMAT_R32G32B32A32_SFLOAT, w, h,
                               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
      images_[i].upload(maps[i].data(), maps[i].size() * sizeof(glm::vec4));
    }
    field_.maps = {&images_[0], &images_[1], &images_[2], &images_[3], &images_[4]};
    for (uint32_t y = 0; y < h; ++y) {
      for (uint32_t x = 0; x < w; ++x) sums_.push_back(oracle::texel_sums(half_, x, y));
    }
  }

  uint32_t texels() const { return static_cast<uint32_t>(sums_.size()); }

  // ids[i] is the cluster of texel i.
  Lights lights(ClusterSumVariant variant, const Ids& ids, uint32_t clusters) {
    Ids order(ids.size()), sorted(ids.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return ids[a] < ids[b]; });
    for (size_t i = 0; i < order.size(); ++i) sorted[i] = ids[order[i]];
    const size_t bytes = std::max<size_t>(ids.size(), 1) * 4;
    Buffer id_buffer(test_device(), "ids", bytes), texel_buffer(test_device(), "texels", bytes);
    Buffer out(test_device(), "lights", clusters * sizeof(gpu::Vsgl));
    if (!ids.empty()) {
      id_buffer.upload(std::span<const uint32_t>(sorted));
      texel_buffer.upload(std::span<const uint32_t>(order));
    }
    const Lights unwritten(clusters, gpu::Vsgl{.level = -7});
    out.upload(std::span<const gpu::Vsgl>(unwritten));
    ClusterSum sum(context_, variant);
    recorder_.begin();
    recorder_.pass({.step = "sum"}, [&] {
      sum.record(recorder_, field_, {&id_buffer, &texel_buffer, static_cast<uint32_t>(ids.size())},
                 {&out, clusters});
    });
    recorder_.submit_and_wait();
    return out.download<gpu::Vsgl>(clusters);
  }

  std::vector<oracle::Vsgl> expected(const Ids& ids, uint32_t clusters) const {
    std::vector<oracle::Sums> sums(clusters);
    for (size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] < clusters) sums[ids[i]].add(sums_[i], 1);
    }
    std::vector<oracle::Vsgl> lights;
    for (const auto& s : sums) lights.push_back(oracle::make_vsgl(s, 1));
    return lights;
  }

 private:
  oracle::Half half_;
  std::vector<oracle::Sums> sums_;
  KernelLibrary kernels_;
  ScratchPool scratch_;
  MethodContext context_;
  Recorder recorder_;
  Field field_;
  std::array<DeviceImage, 5> images_;
};

// Largest differences over all lights. Lengths in units of σ.
struct Difference {
  double power = 0, lobes = 0, axes = 0, sharpness = 0, mean = 0, variance = 0;
};

double relative(const glm::vec3& a, const glm::dvec3& b) {
  return glm::length(glm::dvec3(a) - b) / std::max(glm::length(b), 1e-30);
}

Difference difference(const Lights& lights, const std::vector<oracle::Vsgl>& expected) {
  Difference d;
  const auto see = [](double& worst, double value) {
    worst = std::isnan(value) ? 1e9 : std::max(worst, value);
  };
  for (size_t i = 0; i < lights.size(); ++i) {
    const auto& g = lights[i];
    const auto& e = expected[i];
    EXPECT_EQ(g.level, -1);
    if (!(e.power > 0)) {
      EXPECT_EQ(g.power, 0) << "cluster " << i << " has no power";
      EXPECT_EQ(g.diffuse + g.specular, glm::vec3(0));
      continue;
    }
    see(d.power, std::abs(g.power / e.power - 1));
    see(d.lobes, std::max(relative(g.diffuse, e.diffuse), relative(g.specular, e.specular)));
    see(d.axes,
        std::max(relative(g.diffuse_axis, e.diffuse_axis), relative(g.specular_axis, e.specular_axis)));
    see(d.sharpness, std::max(std::abs(g.diffuse_sharpness / e.diffuse_sharpness - 1),
                              std::abs(g.specular_sharpness / e.specular_sharpness - 1)));
    see(d.mean, glm::length(glm::dvec3(g.mean) - e.mean) / std::sqrt(e.variance));
    see(d.variance, std::abs(g.variance / e.variance - 1));
  }
  return d;
}

// A texel's own moments take some 20 operations of relative error 6e-8: about 1e-6. A sum of at most 64
// terms, four times over, adds at most 4 · 64 · 6e-8 = 1.5e-5 to what it carries, and √(4 · 64) · 6e-8 = 1e-6
// where roundings don't all go one way. Sharpness is (1-q)/q of a carried q, and the lobes' amplitudes follow
// it; axes, mean (in σ) and variance are averages, whose errors average out too.
void expect_close(const Lights& lights, const std::vector<oracle::Vsgl>& expected, const std::string& what) {
  const Difference d = difference(lights, expected);
  EXPECT_LT(d.power, 5e-6) << what;
  EXPECT_LT(d.lobes, 1.5e-5) << what;
  EXPECT_LT(d.axes, 2e-6) << what;
  EXPECT_LT(d.sharpness, 1.5e-5) << what;
  EXPECT_LT(d.mean, 5e-6) << what;
  EXPECT_LT(d.variance, 5e-6) << what;
}

constexpr ClusterSumVariant kVariants[] = {ClusterSumVariant::per_cluster, ClusterSumVariant::segmented};
const char* name(ClusterSumVariant v) {
  return v == ClusterSumVariant::segmented ? "segmented" : "per cluster";
}

// Checks both variants against double precision (so they agree with each other within twice the bounds), and
// that a second run gives the same bits.
void expect_sums(SumBench& bench, const Ids& ids, uint32_t clusters, const std::string& what) {
  const auto expected = bench.expected(ids, clusters);
  for (const auto variant : kVariants) {
    const auto lights = bench.lights(variant, ids, clusters), again = bench.lights(variant, ids, clusters);
    expect_close(lights, expected,
                 fmt::format("{}, {} texels, {} clusters, {}", name(variant), ids.size(), clusters, what));
    EXPECT_EQ(std::memcmp(lights.data(), again.data(), lights.size() * sizeof(gpu::Vsgl)), 0)
        << name(variant) << ": two runs differ";
  }
}

Ids assign(uint32_t count, const std::function<uint32_t(uint32_t)>& id) {
  Ids ids(count);
  for (uint32_t i = 0; i < count; ++i) ids[i] = id(i);
  return ids;
}

// Square blocks of the image, as clusters mostly are.
Ids blocks(uint32_t width, uint32_t height, uint32_t size) {
  return assign(width * height, [=](uint32_t i) {
    return i / width / size * ((width + size - 1) / size) + i % width / size;
  });
}

// One cluster with every second texel, the others spread over the rest.
Ids uneven(uint32_t count, uint32_t clusters) {
  return assign(count, [=](uint32_t i) { return i % 2 ? 7 % clusters : i / 2 % clusters; });
}

TEST(ClusterSums, EverySizeIsAsInDoublePrecision) {
  for (const uint32_t count : {1u, 2u, 255u, 256u, 257u, 700u, 4095u, 4096u, 4097u, 5000u}) {
    SumBench bench(random_half(count, 1, count));
    expect_sums(bench, Ids(count, 0), 1, "all in one");
    expect_sums(bench, assign(count, [](uint32_t i) { return i; }), count, "one each");
    expect_sums(bench, assign(count, [](uint32_t i) { return i * i % 31; }), 31, "31 uneven, some empty");
  }
}

TEST(ClusterSums, FullSizeHalves) {
  SumBench rsm(random_half(512, 512, 1));
  expect_sums(rsm, blocks(512, 512, 16), 1024, "even");
  expect_sums(rsm, uneven(262144, 1024), 1024, "uneven");
  expect_sums(rsm, Ids(262144, 0), 1, "all in one");
  expect_sums(rsm, assign(262144, [](uint32_t i) { return i; }), 262144, "one each");
}

TEST(ClusterSums, FullSizeGBuffer) {
  SumBench gbuffer(random_half(1920, 1088, 2));
  expect_sums(gbuffer, blocks(1920, 1088, 32), 2048, "even, 8 empty");
  expect_sums(gbuffer, uneven(2088960, 2048), 2048, "uneven");
  expect_sums(gbuffer, Ids(2088960, 3), 4, "all in one");
}

TEST(ClusterSums, EmptyClustersAndForeignIds) {
  SumBench bench(random_half(64, 48, 5));
  const uint32_t count = bench.texels();
  // Every cluster number is a multiple of 5; ids of 100 and above belong to none.
  expect_sums(bench, assign(count, [](uint32_t i) { return i % 37 * 5; }), 100, "ids beyond N");
  expect_sums(bench, Ids(count, 100), 100, "no texel in any");
  expect_sums(bench, Ids(count, ~0u), 100, "the largest id");
  expect_sums(bench, {}, 100, "no texels");
  for (const auto variant : kVariants) {
    const auto none = bench.lights(variant, {}, 3);
    EXPECT_EQ(none[2].variance, none[0].variance);
    EXPECT_EQ(none[2].level, -1);
    EXPECT_EQ(none[2].power, 0);
  }
}

TEST(ClusterSums, TexelsWithoutSurfaceOrPowerCountForNothing) {
  auto half = random_half(64, 64, 6);
  for (size_t i = 0; i < half.texels.size(); ++i) {
    if (i % 3 == 0) half.texels[i].surface = false, half.texels[i].position = glm::vec3(0);
    if (i % 3 == 1) half.texels[i].diffuse = half.texels[i].f0 = glm::vec3(0);
    if (i < 1024) half.texels[i].surface = false;
  }
  SumBench bench(half);
  expect_sums(bench, blocks(64, 64, 16), 16, "4 dark clusters");
}

// 1 km from the origin, clusters of σ = 5 cm: E|y|²-|μ|² in single precision would be noise. The mean itself
// is rounded to 3e-5 m a coordinate.
TEST(ClusterSums, FarFromTheOrigin) {
  auto half = random_half(128, 128, 7);
  half.emitter.position += glm::vec3(1000, -700, 500);
  for (auto& t : half.texels) {
    t.position = glm::vec3(t.position.x, 0.02f * t.position.y, t.position.z) + glm::vec3(1000, -697, 500);
  }
  SumBench bench(half);
  const auto ids = blocks(128, 128, 4);
  const auto expected = bench.expected(ids, 1024);
  for (const auto variant : kVariants) {
    const Difference d = difference(bench.lights(variant, ids, 1024), expected);
    EXPECT_LT(d.variance, 5e-6) << name(variant);
    EXPECT_LT(d.mean, 2e-3) << name(variant);
    EXPECT_LT(d.power, 5e-6) << name(variant);
  }
}

// Mirrors that all reflect upwards to within 1e-3: 1-r of a cluster is some 1e-6, of which r in single
// precision keeps 4 bits. The mirror directions' own rounding, 1e-7, is 1e-4 of their differences.
TEST(ClusterSums, SharpLobesKeepTheirSharpness) {
  auto half = random_half(64, 64, 8);
  std::mt19937 random(9);
  const auto noise = [&] { return 1e-3f * (static_cast<float>(random() >> 8) * 0x1p-24f - 0.5f); };
  for (auto& t : half.texels) {
    const glm::vec3 view = glm::normalize(half.emitter.position - t.position);
    t.geometric_normal = {0, 1, 0};
    t.normal = glm::normalize(view + glm::vec3(noise(), 1, noise()));
    t.ndf = 0.001f;
  }
  SumBench bench(half);
  const auto ids = assign(bench.texels(), [](uint32_t i) { return i / 100; });
  const auto expected = bench.expected(ids, 41);
  for (const auto variant : kVariants) {
    const auto lights = bench.lights(variant, ids, 41);
    EXPECT_GT(lights[0].specular_sharpness, 2e5f);
    const auto d = difference(lights, expected);
    EXPECT_LT(d.sharpness, 1e-3) << name(variant) << " " << d.sharpness;
    EXPECT_LT(d.axes, 1e-6) << name(variant);
  }
}

TEST(ClusterSums, MisuseIsRefused) {
  KernelLibrary kernels(test_device());
  ScratchPool scratch(test_device());
  MethodContext context(kernels, scratch, {});
  Recorder recorder(test_device());
  const Buffer small(test_device(), "small", 16);
  ClusterSum sum(context, ClusterSumVariant::segmented);
  EXPECT_THROW(sum.record(recorder, {}, {&small, &small, 100}, {&small, 0}), std::logic_error);
  EXPECT_THROW(sum.record(recorder, {}, {&small, nullptr, 0}, {&small, 0}), std::logic_error);
  EXPECT_THROW(sum.record(recorder, {}, {&small, &small, 4}, {&small, 1}), std::logic_error);
}

}  // namespace
