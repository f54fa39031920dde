// What the cut is for: parts by position, by direction and by the PDF, and closer ones than k-means'.
#include <algorithm>

#include "method/test_field.h"

using namespace vsglbench;

namespace {

using Lights = std::vector<gpu::Vsgl>;

Lights cut(const oracle::Half& half, uint32_t count, const Json& parameters = Json::object(),
           glm::uvec2 shift = {0, 0}) {
  return MethodBench("cut", parameters).lights<gpu::Vsgl>(half, count, shift);
}

oracle::Half uniform_half(uint32_t width, uint32_t height) {
  oracle::Half half = smooth_half(width, height);
  std::ranges::fill(half.pdf, 1.0f);
  return half;
}

// Reflected power of the texels for which `belongs(x, y)`, W.
template <class Belongs>
double power_of(const oracle::Half& half, const Belongs& belongs) {
  double sum = 0;
  for (uint32_t y = 0; y < half.emitter.height; ++y) {
    for (uint32_t x = 0; x < half.emitter.width; ++x) {
      const oracle::Sums t = oracle::texel_sums(half, x, y);
      if (belongs(x, y)) sum += oracle::luminance(t.diffuse) + oracle::luminance(t.specular);
    }
  }
  return sum;
}

// Σ power × variance: how far the lights' texels are from their means, squared.
double spread(const Lights& lights) {
  double sum = 0;
  for (const gpu::Vsgl& light : lights) sum += double{light.power} * light.variance;
  return sum;
}

TEST(Cut, PartsSurfacesThatLieApart) {
  // The columns of a grating, 3 m before what lies behind it.
  const auto before = [](uint32_t x, uint32_t) { return x / 4 % 2 == 0; };
  oracle::Half half = uniform_half(32, 16);
  for (size_t i = 0; i < half.texels.size(); ++i) {
    glm::vec3& p = half.texels[i].position;
    p = glm::vec3(0.3f * p.x, before(i % 32, 0) ? 3.0f : 0.0f, 0.3f * p.z);
  }
  Lights lights = cut(half, 2);
  std::ranges::sort(lights, {}, [](const gpu::Vsgl& light) { return light.mean.y; });
  EXPECT_NEAR(lights[1].mean.y, 3, 1e-4);
  EXPECT_NEAR(lights[0].mean.y, 0, 1e-4);
  EXPECT_NEAR(lights[1].power / power_of(half, before), 1, 1e-4);
  EXPECT_NEAR(lights[0].power / power_of(half, [&](auto x, auto y) { return !before(x, y); }), 1, 1e-4);
}

TEST(Cut, PartsDirectionsAtOnePlaceUnlessToldNotTo) {
  const auto upwards = [](uint32_t x, uint32_t y) { return (x + y) % 2 == 0; };
  oracle::Half half = uniform_half(16, 16);
  for (uint32_t i = 0; i < 256; ++i) {
    oracle::Texel& t = half.texels[i];
    t.position = glm::vec3(0);
    t.normal = t.geometric_normal = upwards(i % 16, i / 16) ? glm::vec3(0, 1, 0) : glm::vec3(0, 0.6f, 0.8f);
  }
  Lights lights = cut(half, 2);
  std::ranges::sort(lights, {}, [](const gpu::Vsgl& light) { return light.diffuse_axis.z; });
  EXPECT_NEAR(lights[0].diffuse_axis.y, 1, 1e-4);
  EXPECT_NEAR(lights[1].diffuse_axis.z, 0.8, 1e-4);
  EXPECT_NEAR(lights[0].power / power_of(half, upwards), 1, 1e-4);
  // Without directions nothing tells the texels apart: one light has them all, the other is none.
  lights = cut(half, 2, {{"direction", 0.0}});
  EXPECT_NEAR(lights[0].power / power_of(half, [](auto...) { return true; }), 1, 1e-4);
  EXPECT_EQ(lights[1].power, 0);
}

// On a line of texels, whose positions deviate by 1 from their mean, every second is turned: along z the
// normals deviate by 0.4 from theirs, and by 0.2 with the half that they count. They are parted by direction
// where that, times what a glossy surface's count more, is above 1.
TEST(Cut, PartsDirectionsTheMoreTheGlossierASurfaceIs) {
  struct Row {
    float diffuse, f0;
    double glossy;
    bool by_direction;
  };
  for (const Row& row : {Row{0, 0.5f, 3.6, false},
                         {0, 0.5f, 4.4, true},
                         {0.3f, 0.3f, 7.2, false},
                         {0.3f, 0.3f, 8.8, true},
                         {0.5f, 0, 100, false}}) {
    oracle::Half half = uniform_half(16, 16);
    for (uint32_t i = 0; i < 256; ++i) {
      oracle::Texel& t = half.texels[i];
      t.position = glm::vec3(float(i % 16), 0, 0);
      t.normal = t.geometric_normal =
          (i % 16 + i / 16) % 2 == 0 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0.6f, 0.8f);
      t.diffuse = glm::vec3(row.diffuse);
      t.f0 = glm::vec3(row.f0);
    }
    const Lights lights = cut(half, 2, {{"glossy", row.glossy}});
    const bool by_direction = std::abs(lights[0].mean.x - lights[1].mean.x) < 2;  // else 8 apart
    EXPECT_EQ(by_direction, row.by_direction) << row.diffuse << " " << row.f0 << " " << row.glossy;
  }
}

TEST(Cut, SpendsLightsWhereThePdfIs) {
  oracle::Half half = uniform_half(64, 64);
  float left = half.texels[0].position.x, right = half.texels[15].position.x;
  for (size_t i = 0; i < half.texels.size(); ++i) {
    const size_t x = i % 64;
    half.pdf[i] = x < 16 ? 1.0f : 1e-3f;
    (x < 16 ? left : right) = std::max(half.texels[i].position.x, x < 16 ? left : right);
  }
  const auto in_quarter = [&](const Lights& lights) {
    return std::ranges::count_if(lights, [&](const gpu::Vsgl& light) { return light.mean.x <= left; });
  };
  // A quarter of the surface with 0.997 of the probability; its error asks for √(0.997/0.003 / 9) times the
  // rest's.
  EXPECT_GT(in_quarter(cut(half, 64)), 50);
  std::ranges::fill(half.pdf, 1.0f);
  EXPECT_LT(in_quarter(cut(half, 64)), 24);
}

TEST(Cut, SpendsFewLightsOnWhatIsSmall) {
  oracle::Half half = uniform_half(64, 64);
  for (size_t i = 0; i < half.texels.size(); ++i) {
    if (i % 64 < 32) half.texels[i].position = glm::vec3(-9, 0, 0) + 0.05f * half.texels[i].position;
  }
  const Lights lights = cut(half, 64, {{"direction", 0.0}});
  const auto small = std::ranges::count_if(lights, [](const auto& l) { return l.mean.x < -8; });
  // Half of the probability on a surface a twentieth as wide: a 21st of the lights.
  EXPECT_GE(small, 1);
  EXPECT_LE(small, 8);
}

TEST(Cut, GivesWhatOneTexelCantUseToNoOther) {
  oracle::Half half = uniform_half(16, 16);
  for (size_t i = 0; i < half.pdf.size(); ++i) half.pdf[i] = i == 77 ? 1.0f : 0.0f;
  const Lights lights = cut(half, 8);
  EXPECT_NEAR(lights[0].power / power_of(half, [](auto...) { return true; }), 1, 1e-4);
  for (size_t i = 1; i < lights.size(); ++i) EXPECT_EQ(lights[i].power, 0) << i;
}

TEST(Cut, IsCloserThanKMeans) {
  const oracle::Half half = smooth_half(96, 64);
  for (const uint32_t count : {16u, 64u, 256u}) {
    double ours = 0, theirs = 0;
    MethodBench cuts("cut", {{"direction", 0.0}}), means("kmeans3d-segmented");
    for (uint32_t seed = 0; seed < 4; ++seed) {
      const glm::uvec2 shift = seed * glm::uvec2(0x9E3779B9u, 0x7F4A7C15u);
      ours += spread(cuts.lights<gpu::Vsgl>(half, count, shift));
      theirs += spread(means.lights<gpu::Vsgl>(half, count, shift));
    }
    EXPECT_LT(ours, theirs) << count << " lights";
  }
}

}  // namespace
