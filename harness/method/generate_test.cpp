// The methods against a double-precision transcription, and the claims of [MFIS16] on made-up PDFs.
#include <numeric>

#include "base/test_chi_squared.h"
#include "method/test_field.h"

using namespace vsglbench;

namespace {

double relative(double a, double b, double scale) { return std::abs(a - b) / std::max(scale, 1e-30); }
double relative(const glm::vec3& a, const glm::dvec3& b) {
  return glm::length(glm::dvec3(a) - b) / std::max(glm::length(b), 1e-30);
}

// Largest relative difference of one light; positions and σ in units of σ.
double difference(const gpu::Vsgl& g, const oracle::Vsgl& c) {
  const double sigma = std::sqrt(c.variance);
  double worst = 0;
  const auto see = [&](double d) { worst = std::max(worst, d); };
  see(relative(g.power, c.power, c.power));
  see(relative(g.diffuse, c.diffuse));
  see(relative(g.specular, c.specular));
  see(glm::length(glm::dvec3(g.diffuse_axis) - c.diffuse_axis));
  see(glm::length(glm::dvec3(g.specular_axis) - c.specular_axis));
  see(relative(g.diffuse_sharpness, c.diffuse_sharpness, c.diffuse_sharpness));
  see(relative(g.specular_sharpness, c.specular_sharpness, c.specular_sharpness));
  see(glm::length(glm::dvec3(g.mean) - c.mean) / sigma);
  see(relative(g.variance, c.variance, c.variance));
  return worst;
}

// Worst difference over all lights but `allowed` ones, whose warp or bisection fell on the other side of a
// comparison in single precision.
double worst_but(std::vector<double> differences, size_t allowed) {
  std::sort(differences.rbegin(), differences.rend());
  return differences.at(allowed);
}

oracle::Half flat_half(uint32_t size, const std::function<float(uint32_t, uint32_t)>& pdf) {
  oracle::Half half = random_half(size, size, 1);
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      auto& t = half.texels[size_t(y) * size + x];
      const glm::vec2 plane = {(2 * (x + 0.5f) / size - 1) * 0.7f, (1 - 2 * (y + 0.5f) / size) * 0.5f};
      t = {.position = half.emitter.position + 4.0f * glm::vec3(plane.x, -1, -plane.y),
           .diffuse = glm::vec3(0.5f)};
      half.pdf[size_t(y) * size + x] = pdf(x, y);
    }
  }
  return half;
}

double total_power(const oracle::Half& half) {
  double total = 0;
  for (uint32_t y = 0; y < half.emitter.height; ++y) {
    for (uint32_t x = 0; x < half.emitter.width; ++x) {
      const auto sums = oracle::texel_sums(half, x, y);
      total += oracle::luminance(sums.diffuse) + oracle::luminance(sums.specular);
    }
  }
  return total;
}

double sum_power(const std::vector<gpu::Vsgl>& lights) {
  return std::accumulate(lights.begin(), lights.end(), 0.0,
                         [](double s, const auto& l) { return s + l.power; });
}

}  // namespace

class FilteredSamplingOracle
    : public ::testing::TestWithParam<std::tuple<std::string, glm::uvec2, uint32_t, double>> {};

TEST_P(FilteredSamplingOracle, MatchesDouble) {
  const auto [method, size, count, k] = GetParam();
  const auto half = random_half(size.x, size.y, size.x + count);
  const oracle::Pyramid pyramid(half);
  MethodBench bench(method, {{"K", k}});
  const glm::uvec2 shift(0x12345678u, 0x9abcdef0u);
  const auto lights = bench.lights<gpu::Vsgl>(half, count, shift);
  std::vector<double> differences;
  for (uint32_t i = 0; i < count; ++i) {
    const auto c = oracle::filtered_light(half, pyramid, bench.info().light_rule, k, count,
                                          lattice_point(i, count, shift));
    differences.push_back(difference(lights[i], c));
  }
  EXPECT_LT(worst_but(differences, count / 100), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FilteredSamplingOracle,
                         ::testing::Values(std::tuple{"fis", glm::uvec2(64, 64), 256u, 1.0},
                                           std::tuple{"mfis", glm::uvec2(64, 64), 256u, 1.0},
                                           std::tuple{"fis", glm::uvec2(61, 35), 100u, 4.0},
                                           std::tuple{"mfis", glm::uvec2(61, 35), 100u, 4.0},
                                           std::tuple{"mfis", glm::uvec2(7, 5), 20u, 1.0},
                                           std::tuple{"fis", glm::uvec2(64, 64), 1u, 1.0},
                                           std::tuple{"mfis", glm::uvec2(1, 1), 1u, 1.0},
                                           std::tuple{"fis", glm::uvec2(1, 1), 1u, 1.0}));

TEST(Generate, OnAUniformPdfBothRulesGiveTheSameLights) {
  const auto half = flat_half(64, [](uint32_t, uint32_t) { return 3.0f; });
  const auto a = MethodBench("fis").lights<gpu::Vsgl>(half, 256);
  const auto b = MethodBench("mfis").lights<gpu::Vsgl>(half, 256);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].level, b[i].level, 6.0 / 4096);  // the bisection's last interval
    EXPECT_NEAR(a[i].power / b[i].power, 1, 1e-3);
    EXPECT_LT(glm::length(a[i].mean - b[i].mean), 1e-3f);
    EXPECT_NEAR(a[i].variance / b[i].variance, 1, 5e-3);
  }
}

TEST(Generate, OnACheckerboardOnlyTheModifiedKernelsKeepTheFlux) {
  const auto half = flat_half(64, [](uint32_t x, uint32_t y) { return (x + y) % 2 ? 1.0f : 0.0f; });
  const double total = total_power(half);
  const double fis = sum_power(MethodBench("fis").lights<gpu::Vsgl>(half, 256)) / total;
  const double mfis = sum_power(MethodBench("mfis").lights<gpu::Vsgl>(half, 256)) / total;
  RecordProperty("fis", std::to_string(fis));
  RecordProperty("mfis", std::to_string(mfis));
  EXPECT_NEAR(mfis, 1, 0.05);
  EXPECT_GT(std::abs(fis - 1), 0.05) << "p(x_i) = 2 at every centre: half the flux is lost";
}

// N = texels on a uniform PDF: kernels shrink to single texels.
TEST(Generate, WithAsManyLightsAsTexelsEachIsATexel) {
  const uint32_t size = 32, count = size * size;
  const auto half = random_half(size, size, 7);
  oracle::Half uniform = half;
  std::fill(uniform.pdf.begin(), uniform.pdf.end(), 1.0f);
  const auto lights = MethodBench("mfis").lights<gpu::Vsgl>(uniform, count);
  const oracle::Pyramid pyramid(uniform);
  size_t lit = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const auto fixed = lattice_point(i, count, {0, 0});
    const auto t = pyramid.warp(unit_interval(fixed).x, unit_interval(fixed).y);
    const auto texel = oracle::make_vsgl(oracle::texel_sums(half, t.x, t.y), 1);
    EXPECT_EQ(lights[i].level, 0);
    if (!(texel.power > 0)) {
      EXPECT_EQ(lights[i].power, 0);
      continue;
    }
    ++lit;
    EXPECT_LT(difference(lights[i], texel), 1e-4) << "light " << i;
  }
  EXPECT_GT(lit, count * 9 / 10);
}

TEST(Generate, APdfThatIsZeroEverywhereGivesNoLight) {
  const auto half = flat_half(16, [](uint32_t, uint32_t) { return 0.0f; });
  for (const char* method : {"fis", "mfis"}) {
    for (const auto& light : MethodBench(method).lights<gpu::Vsgl>(half, 64)) {
      EXPECT_EQ(light.power, 0);
      EXPECT_EQ(light.diffuse, glm::vec3(0));
      EXPECT_TRUE(std::isfinite(light.variance));
    }
  }
  for (const auto& light : MethodBench("vpl").lights<gpu::Vpl>(half, 64)) EXPECT_EQ(light.power, 0);
}

// χ² of the texels that random lattice shifts choose, against the PDF; texels of p = 0 are never chosen.
TEST(Generate, WarpedSamplesFollowThePdf) {
  const uint32_t w = 13, h = 9, count = 64, runs = 1500;
  const auto half = random_half(w, h, 3);
  MethodBench bench("vpl");
  std::mt19937 random(5);
  std::vector<double> hits(w * h, 0);
  for (uint32_t run = 0; run < runs; ++run) {
    // One light a run is kept: lights of one lattice are stratified, not independent.
    const auto lights = bench.lights<gpu::Vpl>(half, count, {random(), random()});
    const auto& light = lights[run % count];
    const auto same = [&](const oracle::Texel& t) { return t.position == light.position; };
    hits[std::find_if(half.texels.begin(), half.texels.end(), same) - half.texels.begin()] += 1;
  }
  const double total = std::accumulate(half.pdf.begin(), half.pdf.end(), 0.0);
  double chi2 = 0;
  int degrees = -1;
  for (size_t i = 0; i < hits.size(); ++i) {
    if (half.pdf[i] == 0) {
      EXPECT_EQ(hits[i], 0) << "a texel of p = 0 was chosen";
      continue;
    }
    const double expected = runs * half.pdf[i] / total;
    chi2 += (hits[i] - expected) * (hits[i] - expected) / expected;
    ++degrees;
  }
  EXPECT_LT(chi2, chi_squared_limit(degrees, 3.0902)) << degrees << " degrees of freedom";
}

// Σ Φ/(N p) over VPLs estimates the flux; the texels' own values are passed on unchanged.
TEST(Generate, VplsCarryTheFluxOfTheirTexels) {
  const auto half = random_half(64, 48, 11);
  const auto lights = MethodBench("vpl").lights<gpu::Vpl>(half, 1024);
  double sum = 0, expected = 0;
  for (const auto& light : lights) sum += light.power;
  for (uint32_t y = 0; y < 48; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      if (half.texels[y * 64 + x].surface)
        expected += oracle::luminance(oracle::texel_flux(half.emitter, x, y));
    }
  }
  EXPECT_NEAR(sum / expected, 1, 0.05);
}
