// Virtual spherical lights: their Monte-Carlo estimate against quadrature in double, and the densities that
// it draws directions by.
#include <algorithm>

#include "base/test_chi_squared.h"
#include "frame/shade_fixture.h"

using namespace vsglbench;

namespace {

using glm::dvec3;
constexpr double kPi = 3.14159265358979323846;

double luminance(const dvec3& c) { return glm::dot(c, dvec3(0.2126, 0.7152, 0.0722)); }

class VslTest : public ShadeTest {
 protected:
  // A light near the pixels that looks their way, with a radius from small to far beyond them.
  gpu::Vpl random_vsl() {
    gpu::Vpl l = random_vpl();
    l.position = 1.5f * (2.0f * color() - 1.0f);
    l.geometric_normal = near(glm::normalize(-l.position));
    l.normal = near(l.geometric_normal);
    l.incident = near(l.normal);
    l.radius = std::exp(4 * uniform() - 3.5f);
    l.samples = 16;
    return l;
  }

  // Luminance of every pixel under light k alone, of independent runs.
  std::vector<std::vector<double>> runs_of(const std::vector<gpu::Vpl>& lights, uint32_t k, uint32_t runs) {
    std::vector<std::vector<double>> out(runs);
    for (auto& run : out) {
      const auto random = static_cast<uint32_t>(random_());
      for (const auto& p : shade(lights, {{"LIGHT_VSL", "1"}}, {.first = k, .count = 1, .random = random}))
        run.push_back(luminance(dvec3(p)));
    }
    return out;
  }
};

// Mean and standard error of independent values.
struct Estimate {
  explicit Estimate(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double square = 0;
    for (const double v : values) mean += v / n;
    for (const double v : values) square += (v - mean) * (v - mean);
    error = std::sqrt(square / (n * (n - 1)));
  }
  static Estimate of(const std::vector<std::vector<double>>& images, size_t pixel) {
    std::vector<double> values;
    for (const auto& image : images) values.push_back(image[pixel]);
    return Estimate(values);
  }
  double mean = 0, error = 0;
};

struct ZStatistics {
  void see(double z) {
    ++count;
    sum += z;
    square += z * z;
    most = std::max(most, std::abs(z));
  }
  double mean_in_errors() const { return sum / std::sqrt(count); }
  double count = 0, sum = 0, square = 0, most = 0;
};

// z = (estimate - integral)/standard error has mean 0 and mean square 1: of each pixel and light whose cone
// is wide enough that all three strategies hit it often, and of each light's mean over pixels, each in units
// of its integral, where narrow cones count as well.
TEST_F(VslTest, TheEstimateIsTheIntegral) {
  constexpr uint32_t light_count = 24, runs = 32, stride = 7;
  std::vector<gpu::Vpl> lights;
  for (uint32_t k = 0; k < light_count; ++k) lights.push_back(random_vsl());
  ZStatistics pairs, means;
  double inside = 0;
  for (uint32_t k = 0; k < light_count; ++k) {
    const auto pilot = runs_of(lights, k, runs), images = runs_of(lights, k, runs);
    std::vector<double> mean(runs, 0), pilot_mean(runs, 0);
    for (size_t i = k % stride; i < pixels_.size(); i += stride) {
      // What is hardly ever hit, such as a sliver above a horizon, has no normal distribution.
      const Estimate p = Estimate::of(pilot, i);
      if (!(p.error > 0 && p.error < 0.2 * p.mean)) continue;
      const double expected = luminance(exact::shade_vsl(pixels_[i], lights[k], 1e-4).value);
      const double sine = lights[k].radius / glm::length(dvec3(lights[k].position) - pixels_[i].position);
      if (sine > 0.4) {
        pairs.see((Estimate::of(images, i).mean - expected) / p.error);
        inside += sine > 1;
      }
      for (uint32_t r = 0; r < runs; ++r) {
        mean[r] += images[r][i] / expected - 1;
        pilot_mean[r] += pilot[r][i] / expected - 1;
      }
    }
    if (const Estimate e(pilot_mean); e.error > 0) means.see(Estimate(mean).mean / e.error);
  }
  for (const auto& [name, z] : {std::pair{"pairs", pairs}, {"lights", means}}) {
    std::printf("%.0f %s: mean z %+.2f standard errors, mean z² %.3f, |z| <= %.2f\n", z.count, name,
                z.mean_in_errors(), z.square / z.count, z.most);
    EXPECT_LT(std::abs(z.mean_in_errors()), 4) << name;
    EXPECT_LT(z.square, chi_squared_limit(z.count, 4)) << name;
    EXPECT_GT(z.square, chi_squared_limit(z.count, -4)) << name;
    EXPECT_LT(z.most, 6) << name;
  }
  EXPECT_GT(pairs.count, 150);
  EXPECT_GT(inside, 50);
  EXPECT_GT(means.count, 15);
}

// Both ends of the integral in double: a far small sphere is a point; from its centre a diffuse one is a
// closed form.
TEST_F(VslTest, TheQuadratureHasItsLimits) {
  for (size_t i = 0; i < pixels_.size(); i += 5) {
    gpu::Vpl l = random_vsl();
    exact::Surface s = pixels_[i];
    l.ndf = 0.5f;
    s.ndf = 0.5;
    l.radius = 1e-3f;
    const dvec3 point = exact::shade_vpl(s, l);
    EXPECT_LT(glm::length(exact::shade_vsl(s, l, 1e-6).value - point), 1e-3 * glm::length(point) + 1e-5) << i;
  }
  // Surfaces that face each other: Φ Rd²/π² ∫cos² over the cone, 2π/3 (1-cos³θ), over πr².
  exact::Surface s = pixels_[0];
  s.normal = s.geometric_normal = s.view = {0, 0, 1};
  s.position = {0, 0, 0};
  s.diffuse = dvec3(0.5);
  s.f0 = dvec3(0);
  gpu::Vpl l{};
  l.normal = l.geometric_normal = l.incident = {0, 0, -1};
  l.diffuse = glm::vec3(0.5);
  l.flux = glm::vec3(1);
  l.power = l.ndf = 1;
  for (const float radius : {0.01f, 1.0f, 1.99f, 2.0f, 5.0f}) {
    l.position = {0, 0, 2};
    l.radius = radius;
    const double sine = std::min(radius / 2.0, 1.0), cosine = std::sqrt(1 - sine * sine);
    const double expected =
        0.25 / (kPi * kPi) * 2 * kPi / 3 * (1 - std::pow(cosine, 3)) / (kPi * double{radius} * radius);
    EXPECT_NEAR(exact::shade_vsl(s, l, 1e-8).value.x / expected, 1, 1e-6) << radius;
  }
}

// The kernels that the estimate is made of, one surface at a time.
class VslSampling : public VslTest {
 protected:
  struct Push {
    glm::vec3 normal;
    float ndf;
    glm::vec3 view;
    float cone = 0;
    glm::vec3 diffuse;
    uint32_t count = 0;
    glm::vec3 f0;
  };
  Push random_push(float ndf) {
    Push p{.normal = direction(), .ndf = ndf, .diffuse = color(), .f0 = color()};
    // Seen at a grazing angle a sharp lobe is narrower than the grid's step.
    const float least = ndf > 0.2f || (ndf < 0 && ndf > -50) ? 0.05f : 0.4f;
    do p.view = direction();
    while (glm::dot(p.view, p.normal) < least);
    return p;
  }
  std::vector<glm::vec4> run(const char* mode, Push push, const std::vector<glm::vec4>& given) {
    const Kernel& kernel =
        kernels().get(data_root() / "harness" / "frame" / "vsl_sampling_test.comp", {{"MODE", mode}});
    const Buffer in = upload(given), out(device(), "values", given.size() * sizeof(glm::vec4));
    push.count = static_cast<uint32_t>(given.size());
    Recorder recorder(device());
    recorder.begin();
    recorder.pass({.step = "sampling"}, [&] {
      recorder.dispatch(kernel, {in, out}, push, groups_for(given.size(), 64));
    });
    recorder.submit_and_wait();
    return out.download<glm::vec4>(given.size());
  }
  std::vector<glm::vec4> random_numbers(uint32_t count) {
    std::vector<glm::vec4> out;
    for (uint32_t i = 0; i < count; ++i) out.emplace_back(color(), 0);
    return out;
  }
};

// A grid about an axis, of equal steps of both angles; each cell of kFine × kFine directions.
struct Grid {
  static constexpr uint32_t kRows = 40, kColumns = 32, kFine = 10;
  explicit Grid(const dvec3& axis) : z(axis) {
    x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    y = glm::cross(z, x);
  }
  static double theta(uint32_t fine_row) { return kPi * (fine_row + 0.5) / (kRows * kFine); }
  std::vector<glm::vec4> directions() const {
    std::vector<glm::vec4> out;
    for (uint32_t i = 0; i < kRows * kFine; ++i) {
      for (uint32_t j = 0; j < kColumns * kFine; ++j) {
        const double t = theta(i), p = 2 * kPi * (j + 0.5) / (kColumns * kFine);
        out.emplace_back(std::cos(t) * z + std::sin(t) * (std::cos(p) * x + std::sin(p) * y), 0);
      }
    }
    return out;
  }
  // ∫ over each cell of values in the order of directions().
  std::vector<double> integrals(const std::vector<glm::vec4>& values) const {
    constexpr uint32_t across = kColumns * kFine;
    std::vector<double> cells(kRows * kColumns, 0);
    for (uint32_t k = 0; k < values.size(); ++k) {
      const uint32_t i = k / across, j = k % across;
      const double area = std::sin(theta(i)) * kPi / (kRows * kFine) * 2 * kPi / across;
      cells[i / kFine * kColumns + j / kFine] += values[k].w * area;
    }
    return cells;
  }
  uint32_t cell(const dvec3& d) const {
    const double t = std::acos(std::clamp(glm::dot(d, z), -1.0, 1.0));
    const double p = std::atan2(glm::dot(d, y), glm::dot(d, x)) / (2 * kPi);
    const auto row = std::min(static_cast<uint32_t>(t / kPi * kRows), kRows - 1);
    return row * kColumns + std::min(static_cast<uint32_t>((p < 0 ? p + 1 : p) * kColumns), kColumns - 1);
  }
  dvec3 x, y, z;
};

// The BRDF's density is no more than 1 in all, and over the hemisphere, where the rest of the estimate lives,
// it is that of the directions drawn.
TEST_F(VslSampling, DirectionsHaveTheirDensity) {
  constexpr uint32_t draws = 1 << 16;
  double least = 1;
  for (int k = 0; k < 20; ++k) {
    Push push = random_push(k == 0 ? 0.05f : k == 1 ? -1000 : std::max(ndf(), -1000.0f));
    if (k == 2) push.diffuse = glm::vec3(0);
    if (k == 3) push.f0 = glm::vec3(0);
    const Grid grid(push.normal);
    const auto expected = grid.integrals(run("0", push, grid.directions()));
    double total = 0, chi2 = 0, degrees = 0, rest = 0, rest_hits = 0;
    for (const double e : expected) total += e;
    EXPECT_LT(total, 1.003) << k;
    least = std::min(least, total);
    std::vector<double> hits(expected.size(), 0);
    for (const auto& l : run("1", push, random_numbers(draws))) ++hits[grid.cell(glm::normalize(dvec3(l)))];
    const auto see = [&](double n, double e) {
      chi2 += (n - e) * (n - e) / e;
      ++degrees;
    };
    for (size_t c = 0; c < expected.size() / 2; ++c) {
      const double e = draws * expected[c];
      if (e >= 10) {
        see(hits[c], e);
      } else {
        rest += e;
        rest_hits += hits[c];
      }
    }
    if (rest >= 10) see(rest_hits, rest);
    EXPECT_LT(chi2, chi_squared_limit(degrees, 4)) << k << ": " << degrees << " cells, ndf " << push.ndf;
  }
  EXPECT_GT(least, 0.5);
}

// Uniform in the cone: 1-cosθ and the angle about the axis in 16 × 16 equal cells; all inside, but for what
// rounding puts on the rim.
TEST_F(VslSampling, TheConeIsSampledUniformly) {
  constexpr uint32_t draws = 1 << 15;
  for (const float cone : {1.0f, 0.3f, 1e-3f, 1e-6f}) {
    Push push = random_push(1);
    push.cone = cone;
    const Grid frame(push.normal);
    std::vector<double> hits(256, 0);
    uint32_t outside = 0, other_density = 0;
    for (const auto& l : run("2", push, random_numbers(draws))) {
      const dvec3 d = dvec3(l) - dvec3(push.normal);
      const double low = 0.5 * glm::dot(d, d) / cone;
      const double p = std::atan2(glm::dot(d, frame.y), glm::dot(d, frame.x)) / (2 * kPi) + 0.5;
      ++hits[std::min(static_cast<int>(16 * low), 15) * 16 + std::min(static_cast<int>(16 * p), 15)];
      outside += l.w == 0;
      other_density += l.w != 0 && std::abs(l.w * 2 * kPi * cone - 1) > 1e-5;
    }
    double chi2 = 0;
    for (const double n : hits) chi2 += (n - draws / 256) * (n - draws / 256) / (draws / 256);
    EXPECT_LT(chi2, chi_squared_limit(255, 4)) << cone;
    EXPECT_LE(outside, draws / 1000) << cone;
    EXPECT_EQ(other_density, 0u) << cone;
  }
}

}  // namespace
