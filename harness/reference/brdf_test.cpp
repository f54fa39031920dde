#include "reference/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/test_chi_squared.h"
#include "reference/random.h"

namespace vsglbench {
namespace {

constexpr double kPi = std::numbers::pi;

Surface make_surface(float ndf, const glm::vec3& diffuse, const glm::vec3& f0) {
  Surface s;
  s.geometric_normal = s.normal = glm::normalize(glm::vec3(0.3f, 0.8f, -0.2f));
  s.diffuse = diffuse;
  s.f0 = f0;
  s.ndf = ndf;
  return s;
}

glm::vec3 direction(const Surface& s, double cosine, double angle) {
  glm::vec3 x, y;
  tangent_frame(s.normal, &x, &y);
  const double sine = std::sqrt(1 - cosine * cosine);
  return glm::normalize(glm::vec3(glm::dvec3(x) * (sine * std::cos(angle)) +
                                  glm::dvec3(y) * (sine * std::sin(angle)) + glm::dvec3(s.normal) * cosine));
}

struct Lobe {
  std::string name;
  float ndf;
};
std::vector<Lobe> lobes() {
  return {{"ggx 1e-3", 1e-3f},   {"ggx 0.05", 0.05f},     {"ggx 0.3", 0.3f},
          {"ggx 1", 1},          {"phong 1", -1},         {"phong 40", -40},
          {"phong 1023", -1023}, {"phong 65535", -65535}, {"phong 1e7", -1e7f}};
}

// The model once more, in double and in the textbooks' forms where those keep their digits.
glm::dvec3 textbook(const Surface& s, const glm::vec3& v, const glm::vec3& l) {
  // Unit in double: fp32's |n| - 1 of 3e-8, to the power of 1e7, would be a factor.
  const glm::dvec3 n = glm::normalize(glm::dvec3(s.normal)), dv = glm::normalize(glm::dvec3(v));
  const glm::dvec3 dl = glm::normalize(glm::dvec3(l)), h = glm::normalize(dv + dl);
  const double nl = glm::dot(n, dl), nv = glm::dot(n, dv), nh = glm::dot(n, h), lh = glm::dot(dl, h);
  if (nl <= 0 || nv <= 0 || glm::dot(glm::dvec3(s.geometric_normal), dl) <= 0) return glm::dvec3(0);
  double d, a2;
  if (s.ndf > 0) {
    a2 = double(s.ndf) * s.ndf;
    const double t2 = glm::dot(glm::cross(n, h), glm::cross(n, h)) / (nh * nh);  // Walter 2007, Eq. 33
    d = a2 / (kPi * std::pow(nh, 4) * (a2 + t2) * (a2 + t2));
  } else {
    const double e = -double(s.ndf);
    a2 = 2 / (e + 2);
    d = (e + 2) / (2 * kPi) * std::pow(nh, e);
  }
  const auto lambda = [&](double c) {
    return 0.5 * (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1);
  };  // Heitz 2014
  const double g = 1 / (1 + lambda(nl) + lambda(nv));
  const glm::dvec3 f0(s.f0);
  const double f90 = std::min(1.0, 50 * std::max(f0.x, std::max(f0.y, f0.z)));
  const glm::dvec3 f = f0 + (f90 - f0) * std::pow(1 - lh, 5);
  return glm::dvec3(s.diffuse) / kPi + d * g * f / (4 * nl * nv);
}

TEST(Brdf, MatchesTheTextbookFormsInDouble) {
  for (const Lobe& lobe : lobes()) {
    const Surface s = make_surface(lobe.ndf, {0.3f, 0.5f, 0.2f}, {0.04f, 0.2f, 0.9f});
    // Directions near the mirror one, at the lobe's own width, where all the energy is.
    const double width = lobe.ndf > 0 ? lobe.ndf : std::sqrt(2 / (2.0 - lobe.ndf));
    for (int i = 0; i < 400; ++i) {
      const glm::vec4 r = random4(7, Stream::light, 0, uint32_t(i));
      const glm::vec3 v = direction(s, 0.05 + 0.9 * r.x, 6.28 * r.y);
      const glm::vec3 h = direction(s, std::cos(std::min(1.0, 2 * width * r.z)), 6.28 * r.w);
      const glm::vec3 l = glm::normalize(2 * glm::dot(v, h) * h - v);
      const glm::dvec3 want = textbook(s, v, l);
      const glm::vec3 got = Brdf(s, v).f(l);
      // Near grazing n.l keeps few digits. fp32 directions err by 1e-7 of a radian: about 1e-7/width of the
      // lobe.
      if (glm::dot(s.normal, l) < 0.02) continue;
      const double tolerance = 1e-4 + 5e-6 / width;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got[c], want[c], tolerance * want[c]) << lobe.name << " sample " << i;
    }
  }
}

TEST(Brdf, IsReciprocal) {
  for (const Lobe& lobe : lobes()) {
    const Surface s = make_surface(lobe.ndf, {0.3f, 0.5f, 0.2f}, {0.04f, 0.2f, 0.9f});
    for (int i = 0; i < 200; ++i) {
      const glm::vec4 r = random4(9, Stream::light, 0, uint32_t(i));
      const glm::vec3 a = direction(s, 0.05 + 0.9 * r.x, 6.28 * r.y),
                      b = direction(s, 0.05 + 0.9 * r.z, 6.28 * r.w);
      const glm::vec3 ab = Brdf(s, a).f(b), ba = Brdf(s, b).f(a);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(ab[c], ba[c], 1e-4f * ab[c]) << lobe.name;
    }
  }
}

TEST(Brdf, IsZeroBehindEitherNormal) {
  Surface s = make_surface(0.5f, {0.5f, 0.5f, 0.5f}, {0.04f, 0.04f, 0.04f});
  s.geometric_normal = direction(s, 0.8, 1.0);
  const glm::vec3 v = direction(s, 0.9, 1.0);
  glm::vec3 x, y;
  tangent_frame(s.normal, &x, &y);
  int tested = 0;
  for (int i = 0; i < 500; ++i) {
    const glm::vec4 r = random4(3, Stream::light, 0, uint32_t(i));
    const glm::vec3 l = direction(s, 2 * r.x - 1, 6.28 * r.y);
    const bool lit = glm::dot(l, s.normal) > 0 && glm::dot(l, s.geometric_normal) > 0;
    EXPECT_EQ(Brdf(s, v).f(l).x > 0, lit);
    tested += !lit && glm::dot(l, s.normal) > 0;  // the geometric normal alone says no
  }
  EXPECT_GT(tested, 10);
}

// Histogram of sample() over (cosine, angle) cells about the lobe against the integral of pdf() over each.
void expect_samples_follow_pdf(const Surface& s, const glm::vec3& v, const std::string& name) {
  constexpr int rings = 24, sectors = 16, n = 400000;
  const double width = s.ndf > 0 ? s.ndf : std::sqrt(2 / (2.0 - s.ndf));
  const glm::dvec3 axis(glm::normalize(2 * glm::dot(s.normal, v) * s.normal - v));
  glm::vec3 x, y;
  tangent_frame(glm::vec3(axis), &x, &y);
  // Rings in angle about the mirror direction, geometric so that the sharp lobe and the rest are both
  // resolved.
  const double least = std::min(0.05, 0.2 * width), ratio = std::pow(kPi / least, 1.0 / (rings - 1));
  const auto edge = [&](double i) { return i <= 0 ? 0.0 : least * std::pow(ratio, i - 1); };
  std::vector<double> want(rings * sectors, 0), got(rings * sectors, 0);
  constexpr int sub = 48;
  const Brdf brdf(s, v);
  for (int i = 0; i < rings * sub; ++i) {
    const double ring = (i + 0.5) / sub, t0 = edge(std::floor(ring)), t1 = edge(std::floor(ring) + 1);
    const double f = ring - std::floor(ring), theta = t0 + f * (t1 - t0);
    for (int j = 0; j < sectors * sub; ++j) {
      const double angle = 2 * kPi * (j + 0.5) / (sectors * sub);
      const glm::dvec3 l =
          std::sin(theta) * (std::cos(angle) * glm::dvec3(x) + std::sin(angle) * glm::dvec3(y)) +
          std::cos(theta) * axis;
      const double solid_angle = std::sin(theta) * (t1 - t0) / sub * 2 * kPi / (sectors * sub);
      want[i / sub * sectors + j / sub] += brdf.pdf(glm::vec3(l)) * solid_angle;
    }
  }
  double nothing = 0;
  for (int i = 0; i < n; ++i) {
    glm::vec3 l;
    if (!brdf.sample(glm::vec3(random4(11, Stream::receiver, 0, uint32_t(i))), &l)) {
      nothing += 1.0 / n;
      continue;
    }
    const glm::dvec3 d(l);
    const double theta = std::atan2(glm::length(glm::cross(axis, d)), glm::dot(axis, d));
    const double angle = std::atan2(glm::dot(d, glm::dvec3(y)), glm::dot(d, glm::dvec3(x)));
    const int ring =
        theta < least ? 0 : std::min(rings - 1, 1 + int(std::log(theta / least) / std::log(ratio)));
    const int sector =
        std::min(sectors - 1, int((angle < 0 ? angle + 2 * kPi : angle) / (2 * kPi) * sectors));
    got[ring * sectors + sector] += 1;
  }
  double total = 0, chi2 = 0;
  int cells = 0;
  for (size_t i = 0; i < want.size(); ++i) {
    total += want[i];
    if (want[i] * n < 20) continue;
    // About -v the density has a pole, 1/(v.h), that the midpoints above don't resolve.
    const double theta = 0.5 * (edge(double(i / sectors)) + edge(double(i / sectors) + 1));
    const double angle = 2 * kPi * (double(i % sectors) + 0.5) / sectors;
    const glm::dvec3 l =
        std::sin(theta) * (std::cos(angle) * glm::dvec3(x) + std::sin(angle) * glm::dvec3(y)) +
        std::cos(theta) * axis;
    if (glm::dot(l, glm::dvec3(v)) < -0.7) continue;
    // 1 % of slack a cell for the quadrature and the fp32 directions, beside Poisson's own variance.
    const double expected = want[i] * n;
    chi2 += (got[i] - expected) * (got[i] - expected) / (expected + 1e-4 * expected * expected);
    ++cells;
  }
  EXPECT_NEAR(total, 1 - nothing, 0.01) << name;
  EXPECT_GT(cells, 10) << name;
  EXPECT_LT(chi2, chi_squared_limit(cells, 4)) << name << ", cells " << cells;
}

TEST(Brdf, SamplesFollowThePdfAndItIntegratesToOne) {
  for (const Lobe& lobe : lobes()) {
    for (const double cosine : {0.95, 0.4, 0.1}) {
      const Surface s = make_surface(lobe.ndf, {0.2f, 0.2f, 0.2f}, {0.5f, 0.5f, 0.5f});
      expect_samples_follow_pdf(s, direction(s, cosine, 0.7), lobe.name + " at " + std::to_string(cosine));
    }
  }
  const Surface diffuse = make_surface(1, {0.5f, 0.5f, 0.5f}, {0, 0, 0});
  expect_samples_follow_pdf(diffuse, direction(diffuse, 0.5, 0.7), "lambert");
}

// White furnace: what a surface in uniform light reflects. Sampled with its own pdf: also shows that f and
// pdf belong together (a lobe of the wrong normalisation would not reach 1 when smooth).
double albedo(const Surface& s, const glm::vec3& v) {
  const Brdf brdf(s, v);
  constexpr uint32_t n = 20000;
  double sum = 0;
  const PointLattice lattice(n, {0x1000, 0x3000, 0x7000});
  for (uint32_t i = 0; i < n; ++i) {
    glm::vec3 l;
    if (!brdf.sample(lattice.point(i), &l)) continue;
    const BrdfValue value = brdf.evaluate(l);
    if (value.pdf > 0) sum += value.f.x * glm::dot(s.normal, l) / value.pdf;
  }
  return sum / n;
}

TEST(Brdf, KeepsEnergy) {
  for (const Lobe& lobe : lobes()) {
    const Surface white = make_surface(lobe.ndf, {0, 0, 0}, {1, 1, 1});
    for (const double cosine : {0.02, 0.1, 0.3, 0.6, 1.0}) {
      EXPECT_LE(albedo(white, direction(white, cosine, 2)), 1.01) << lobe.name << " at " << cosine;
    }
    const bool sharp = (lobe.ndf > 0 && lobe.ndf < 0.01) || lobe.ndf < -1000;
    if (sharp) {
      EXPECT_GE(albedo(white, direction(white, 0.7, 2)), 0.99) << lobe.name;
    }
  }
  const Surface diffuse = make_surface(1, {0.8f, 0.8f, 0.8f}, {0, 0, 0});
  EXPECT_NEAR(albedo(diffuse, direction(diffuse, 0.4, 1)), 0.8, 1e-4);
}

TEST(Brdf, IsFiniteAtTheLimits) {
  for (const Lobe& lobe : lobes()) {
    const Surface s = make_surface(lobe.ndf, {0.5f, 0.5f, 0.5f}, {1, 1, 1});
    for (const double cv : {1e-6, 0.01, 1.0}) {
      for (const double cl : {1e-6, 0.01, 1.0}) {
        for (const double angle : {0.0, kPi}) {
          const BrdfValue value = Brdf(s, direction(s, cv, 0)).evaluate(direction(s, cl, angle));
          EXPECT_TRUE(std::isfinite(value.f.x) && std::isfinite(value.pdf)) << lobe.name;
          EXPECT_GE(value.f.x, 0);
        }
      }
    }
    for (const float u : {0.0f, 1 - 0x1p-24f}) {
      glm::vec3 l;
      if (Brdf(s, direction(s, 0.5, 0)).sample({u, u, 1 - 0x1p-24f}, &l)) {
        EXPECT_NEAR(glm::length(l), 1, 1e-5) << lobe.name;
      }
    }
  }
}

}  // namespace
}  // namespace vsglbench
