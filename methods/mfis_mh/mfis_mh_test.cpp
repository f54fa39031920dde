// The centres: how they are distributed, and how many stay where they are when the PDF changes a little.
#include <algorithm>
#include <numeric>

#include "method/test_field.h"

using namespace vsglbench;

namespace {

using Texels = std::vector<uint32_t>;

// Centres' texels, y·width + x. With footprints of next to no probability each light is its centre's texel,
// and its mean that texel's position.
Texels centres(const oracle::Half& half, const std::vector<gpu::Vsgl>& lights) {
  const gpu::Emitter& e = half.emitter;
  Texels out;
  for (const auto& l : lights) {
    const glm::vec3 d = l.mean - e.position;
    const glm::vec2 plane =
        glm::vec2(glm::dot(d, e.right), glm::dot(d, e.up)) / (glm::dot(d, e.forward) * e.extent);
    const auto x = static_cast<uint32_t>((0.5f + 0.5f * plane.x) * static_cast<float>(e.width));
    const auto y = static_cast<uint32_t>((0.5f - 0.5f * plane.y) * static_cast<float>(e.height));
    out.push_back(y * e.width + x);
    EXPECT_LT(glm::distance(half.texels.at(out.back()).position, l.mean), 1e-5f);
  }
  return out;
}

Texels centres(const std::string& method, const oracle::Half& half, uint32_t count,
               Json parameters = Json::object(), glm::uvec2 shift = {0, 0}) {
  parameters["K"] = 1e-6;
  return centres(half, MethodBench(method, parameters).lights<gpu::Vsgl>(half, count, shift));
}

// Chains that are carried over from frame to frame.
class CarriedChains {
 public:
  CarriedChains(uint32_t count, uint32_t steps)
      : count_(count),
        bench_("mfis-mh", {{"K", 1e-6}, {"steps", steps}, {"chains", "carried"}}),
        state_(test_device(), "chains", count * 3 * sizeof(float)) {
    restart();
  }
  void restart() {
    state_.fill(0, state_.size(), 0);
    frame_ = 0;
  }
  std::vector<gpu::Vsgl> lights(const oracle::Half& half, glm::uvec2 shift = {0, 0}) {
    return bench_.lights<gpu::Vsgl>(half, count_, shift, {&state_, frame_++});
  }
  Texels next(const oracle::Half& half, glm::uvec2 shift = {0, 0}) {
    return centres(half, lights(half, shift));
  }
  Texels after(const oracle::Half& half, uint32_t frames) {
    for (uint32_t i = 1; i < frames; ++i) next(half);
    return next(half);
  }

 private:
  uint32_t count_, frame_ = 0;
  MethodBench bench_;
  Buffer state_;
};

// χ² of N independent draws against N p, over its degrees of freedom: 1, with a standard deviation of 0.044
// for the 1024 texels of these tests.
double misfit(const oracle::Half& half, const Texels& texels) {
  std::vector<double> hits(half.pdf.size(), 0);
  for (const uint32_t t : texels) ++hits[t];
  const double sum = std::accumulate(half.pdf.begin(), half.pdf.end(), 0.0);
  double chi2 = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const double expected = static_cast<double>(texels.size()) * half.pdf[i] / sum;
    chi2 += (hits[i] - expected) * (hits[i] - expected) / expected;
  }
  return chi2 / static_cast<double>(hits.size() - 1);
}
constexpr uint32_t kDraws = 16384;
constexpr double kMostMisfit = 1.18;  // four standard deviations

double chains_misfit(const oracle::Half& half, uint32_t steps) {
  return misfit(half, centres("mfis-mh", half, kDraws, {{"steps", steps}}));
}

// p of 1 but for a round Gaussian peak `height` times as high, of a standard deviation in widths of the
// image.
oracle::Half peaked_half(uint32_t size, float height, float deviation) {
  oracle::Half half = smooth_half(size, size);
  for (uint32_t i = 0; i < size * size; ++i) {
    const uint32_t column = i % size, row = i / size;
    const float x = (static_cast<float>(column) + 0.5f) / static_cast<float>(size) - 0.61f;
    const float y = (static_cast<float>(row) + 0.5f) / static_cast<float>(size) - 0.37f;
    half.pdf[i] = 1 + height * std::exp(-0.5f * (x * x + y * y) / (deviation * deviation));
  }
  return half;
}

// p times a wave of this amplitude: what a frame changes.
oracle::Half waved(oracle::Half half, float amplitude) {
  const uint32_t w = half.emitter.width;
  for (size_t i = 0; i < half.pdf.size(); ++i) {
    const size_t column = i % w, row = i / w;
    const float u = static_cast<float>(column) / static_cast<float>(w),
                v = static_cast<float>(row) / static_cast<float>(w);
    half.pdf[i] *= 1 + amplitude * std::sin(5 * u + 1) * std::cos(4 * v);
  }
  return half;
}

double share_of_equal(const Texels& a, const Texels& b) {
  double same = 0;
  for (size_t i = 0; i < a.size(); ++i) same += a[i] == b[i];
  return same / static_cast<double>(a.size());
}

double share_that_stays(const std::string& method, const oracle::Half& half, float amplitude,
                        uint32_t count) {
  return share_of_equal(centres(method, half, count), centres(method, waved(half, amplitude), count));
}

TEST(MfisMh, CentresFollowThePdf) {
  const oracle::Half half = smooth_half(32, 32);
  const double chains = chains_misfit(half, 64);
  EXPECT_LT(chains, kMostMisfit);
  EXPECT_GT(chains, 0.8) << "they are independent draws";
  EXPECT_LT(misfit(half, centres("mfis", half, kDraws)), 0.1) << "which warping betters: it is stratified";
}

// A peak of 61 times the mean: a start from anywhere would need hundreds of steps.
TEST(MfisMh, APeakTakesNoMoreSteps) {
  const oracle::Half half = peaked_half(32, 100, 0.03f);
  EXPECT_LT(chains_misfit(half, 16), kMostMisfit);
}

TEST(MfisMh, CentresStayWhereThePdfChangesALittle) {
  const oracle::Half half = smooth_half(256, 256);
  EXPECT_GT(share_that_stays("mfis-mh", half, 0.02f, 1024), 0.97);
  EXPECT_LT(share_that_stays("mfis", half, 0.02f, 1024), 0.5);
  EXPECT_GT(share_that_stays("mfis-mh", half, 0.1f, 1024), 0.92);
  EXPECT_LT(share_that_stays("mfis", half, 0.1f, 1024), 0.1);
}

TEST(MfisMh, OfAPdfOfOneTexelEveryCentreIsThere) {
  oracle::Half half = smooth_half(256, 256);
  std::ranges::fill(half.pdf, 0.0f);
  half.pdf[200 * 256 + 77] = 2;
  for (const uint32_t t : centres("mfis-mh", half, 1024, {{"steps", 1}})) EXPECT_EQ(t, 200u * 256 + 77);
}

TEST(MfisMh, CarriedChainsStartAsFreshOnes) {
  const oracle::Half half = smooth_half(64, 64), other = peaked_half(64, 100, 0.03f);
  CarriedChains chains(1024, 16);
  const Texels fresh = centres("mfis-mh", half, 1024, {{"steps", 16}}, {5, 7});
  EXPECT_EQ(chains.next(half, {5, 7}), fresh);
  EXPECT_NE(chains.next(half, {5, 7}), fresh);
  chains.next(other, {5, 7});
  chains.restart();
  EXPECT_EQ(chains.next(half, {5, 7}), fresh);
  // A frame by itself is none of an animation.
  EXPECT_EQ(centres("mfis-mh", half, 1024, {{"steps", 16}, {"chains", "carried"}}, {5, 7}), fresh);
}

// However few steps a frame has: the chain was distributed as p before. Steps with the random numbers of the
// frame before would climb.
TEST(MfisMh, CarriedChainsFollowThePdf) {
  for (const uint32_t steps : {1u, 4u}) {
    for (const oracle::Half& half : {smooth_half(32, 32), peaked_half(32, 100, 0.03f)}) {
      const double chains = misfit(half, CarriedChains(kDraws, steps).after(half, 12));
      EXPECT_LT(chains, kMostMisfit) << steps;
      EXPECT_GT(chains, 0.8) << steps;
    }
  }
}

TEST(MfisMh, CarriedChainsFollowAPdfThatChanges) {
  const oracle::Half before = smooth_half(32, 32), now = waved(before, 0.5f);
  CarriedChains chains(kDraws, 8);
  EXPECT_GT(misfit(now, chains.next(before)), 2 * kMostMisfit);
  EXPECT_LT(misfit(now, chains.after(now, 8)), kMostMisfit);
}

// Of a PDF that stands still, too: it is each chain's own random numbers that move it.
TEST(MfisMh, TheFewerStepsTheMoreCarriedCentresStay) {
  const oracle::Half half = smooth_half(256, 256);
  const auto share = [&](uint32_t steps) {
    CarriedChains chains(1024, steps);
    const Texels before = chains.after(half, 3);
    return share_of_equal(before, chains.next(half));
  };
  EXPECT_LT(share(64), 0.05);
  EXPECT_GT(share(1), 0.05);
  EXPECT_GT(share(1), 4 * share(2));
}

TEST(MfisMh, CarriedChainsThatLoseThePdfStartAnew) {
  oracle::Half half = smooth_half(256, 256);
  CarriedChains chains(1024, 1);
  std::vector<float> all = half.pdf;
  std::ranges::fill(half.pdf, 0.0f);
  chains.lights(half);  // none, and chains without a point
  half.pdf[200 * 256 + 77] = 2;
  for (const uint32_t t : chains.after(half, 2)) EXPECT_EQ(t, 200u * 256 + 77);
  half.pdf = all;
  chains.restart();
  chains.after(half, 2);
  std::ranges::fill(half.pdf, 0.0f);
  half.pdf[200 * 256 + 77] = 2;
  for (const uint32_t t : chains.next(half)) EXPECT_EQ(t, 200u * 256 + 77);
}

}  // namespace
