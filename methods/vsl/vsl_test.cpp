// The radii against FLANN's exact search.
#include <algorithm>
#include <flann/flann.hpp>

#include "method/test_field.h"

using namespace vsglbench;

namespace {

using Lights = std::vector<gpu::Vpl>;

Lights vsl(const oracle::Half& half, uint32_t count, uint32_t k, float scale = 1) {
  return MethodBench("vsl", {{"k", k}, {"radius_scale", scale}})
      .lights<gpu::Vpl>(half, count, {77u << 20, 5u << 25});
}

// Distance of each light's k-th nearest among the others that carry power, of fewer the farthest, 0 of none.
std::vector<float> flann_distances(const Lights& lights, uint32_t k) {
  std::vector<float> to;
  for (const auto& l : lights) {
    if (l.power > 0) to.insert(to.end(), {l.position.x, l.position.y, l.position.z});
  }
  std::vector<float> out(lights.size(), 0.0f);
  if (to.empty()) return out;
  flann::KDTreeSingleIndex<flann::L2_Simple<float>> index({to.data(), to.size() / 3, 3},
                                                          flann::KDTreeSingleIndexParams());
  index.buildIndex();
  for (size_t i = 0; i < lights.size(); ++i) {
    // One more than k where the light finds itself, or one that stands where it does.
    const size_t own = lights[i].power > 0 ? 1 : 0, found = std::min<size_t>(k + own, to.size() / 3);
    std::vector<int> ids(found);
    std::vector<float> distances(found);
    flann::Matrix<int> id_row(ids.data(), 1, found);
    flann::Matrix<float> distance_row(distances.data(), 1, found);
    glm::vec3 position = lights[i].position;
    index.knnSearch({&position.x, 1, 3}, id_row, distance_row, found,
                    flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    if (found > own) out[i] = std::sqrt(distances.back());
  }
  return out;
}

// √(a/π) of the area that a light's share of texels covers, one at least.
double share_radius(const oracle::Half& half, const gpu::Vpl& light, size_t count) {
  const uint32_t w = half.emitter.width;
  const auto same = [&](const oracle::Texel& t) { return t.position == light.position; };
  const auto i = static_cast<uint32_t>(std::ranges::find_if(half.texels, same) - half.texels.begin());
  double sum = 0;
  for (const float p : half.pdf) sum += p;
  const oracle::Sums s = oracle::texel_sums(half, i % w, i / w);
  const double weight = oracle::luminance(s.diffuse) + oracle::luminance(s.specular);
  const glm::dvec3 mean = s.position / weight;
  const double footprint = 6 * (s.square / weight - glm::dot(mean, mean));  // its variance is a sixth
  const double share = std::max(sum / (static_cast<double>(count) * half.pdf[i]), 1.0);
  return std::sqrt(share * footprint / 3.14159265358979323846);
}

// Lights whose radius the search leaves at their share's.
size_t expect_as_flann(const oracle::Half& half, const Lights& lights, uint32_t k, float scale = 1) {
  const auto expected = flann_distances(lights, k);
  size_t wrong = 0, alone = 0;
  for (size_t i = 0; i < lights.size(); ++i) {
    const bool is_alone = expected[i] == 0;
    if (is_alone && !(lights[i].power > 0)) continue;
    alone += is_alone;
    const double radius =
        is_alone ? share_radius(half, lights[i], lights.size()) : double{scale} * expected[i];
    wrong += !(std::abs(lights[i].radius / radius - 1) < (is_alone ? 1e-3 : 1e-6));
  }
  EXPECT_EQ(wrong, 0u) << lights.size() << " lights, k = " << k;
  return alone;
}

TEST(VslRadii, AreTheDistancesOfTheNearestNeighbours) {
  const oracle::Half half = random_half(128, 96, 4);
  // At k = 32 a dispatch looks at 1818 lights, at k = 10 at 5454.
  for (const uint32_t count : {1u, 2u, 10u, 2000u, 6000u}) {
    for (const uint32_t k : {1u, 10u, 32u}) {
      const Lights lights = vsl(half, count, k);
      const size_t alone = expect_as_flann(half, lights, k);
      EXPECT_EQ(count == 1, alone == count);
    }
  }
}

TEST(VslRadii, AreScaled) {
  const oracle::Half half = random_half(64, 64, 5);
  expect_as_flann(half, vsl(half, 300, 10, 0.37f), 10, 0.37f);
}

// A quarter of the probability on ten texels: many lights share one.
TEST(VslRadii, CountEveryLightOfATexel) {
  oracle::Half half = random_half(64, 64, 6);
  double sum = 0;
  for (const float p : half.pdf) sum += p;
  for (size_t i = 0, peaks = 0; peaks < 10; i += 401) {
    if (!half.texels[i].surface) continue;
    half.pdf[i] = static_cast<float>(sum / 30);
    ++peaks;
  }
  for (const uint32_t k : {1u, 10u, 32u}) {
    const size_t alone = expect_as_flann(half, vsl(half, 2000, k), k);
    EXPECT_GT(alone, 300u) << "more lights than k on one texel keep their share's radius";
    EXPECT_LT(alone, 1900u);
  }
}

// Texels without a surface lie at the origin, in the midst of the others if these are moved there.
TEST(VslRadii, OfLightsWithoutPowerNoneIsANeighbour) {
  oracle::Half half = random_half(64, 64, 7);
  for (size_t i = 0; i < half.texels.size(); ++i) {
    half.texels[i].surface = i % 3 != 0;
    half.pdf[i] = 1;
  }
  const Lights lights = vsl(half, 2000, 10);
  const auto dark = std::ranges::count_if(lights, [](const auto& l) { return !(l.power > 0); });
  EXPECT_GT(dark, 500);
  expect_as_flann(half, lights, 10);
  for (auto& t : half.texels) t.surface = false;
  for (const auto& l : vsl(half, 100, 10)) EXPECT_TRUE(std::isfinite(l.radius));
}

}  // namespace
