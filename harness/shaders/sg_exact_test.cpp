// The double-precision oracle against closed forms, and its quadrature against another integral.
#include "shaders/sg_exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace vsglbench;
using glm::dvec3;

namespace {

constexpr double kPi = std::numbers::pi;

double relative(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

// L(v,κ) and the hemispherical integral from ∫₀¹ f(μ) 2π e^{κ(cμ-1)} I₀(κ√(1-c²)√(1-μ²)) dμ, about n and not
// about v, by Simpson's rule in μ = sin t: for small κ.
double about_normal(double c, double k, double (*f)(double)) {
  constexpr int kSteps = 16000;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = 0.5 * kPi * i / kSteps, mu = std::sin(t);
    const double bessel = std::cyl_bessel_i(0.0, k * std::sqrt(1 - c * c) * std::cos(t));
    const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * f(mu) * 2 * kPi * std::exp(k * (c * mu - 1)) * bessel * std::cos(t);
  }
  return sum * 0.5 * kPi / kSteps / 3;
}

}  // namespace

TEST(SgExact, IntegralAtItsEnds) {
  EXPECT_EQ(exact::sg_integral(0), 4 * kPi);
  EXPECT_LT(relative(exact::sg_integral(1), 2 * kPi * (1 - std::exp(-2.0))), 1e-15);
  EXPECT_LT(relative(exact::sg_integral(1e12), 2 * kPi / 1e12), 1e-15);
  EXPECT_LT(relative(exact::sg_integral(1e-9), 4 * kPi * (1 - 1e-9)), 1e-15);
  EXPECT_LT(relative(exact::vmf_normalization(3) * exact::sg_integral(3), 1), 1e-15);
}

TEST(SgExact, ProductIsTheProduct) {
  const dvec3 a = glm::normalize(dvec3(1, 2, -3)), b = glm::normalize(dvec3(-2, 0.5, 1));
  const exact::SgProduct p = exact::sg_product(a, 3, b, 0.7);
  for (const dvec3& w : {a, b, glm::normalize(dvec3(0.1, -1, 2))}) {
    const double together = std::exp(p.log_amplitude) * exact::sg_value(w, p.axis, p.sharpness);
    EXPECT_LT(relative(together, exact::sg_value(w, a, 3) * exact::sg_value(w, b, 0.7)), 1e-14);
  }
  const exact::SgProduct opposite = exact::sg_product(a, 5, -a, 5);
  EXPECT_NEAR(opposite.log_amplitude, -10, 1e-14);
  EXPECT_NEAR(opposite.sharpness, 0, 1e-14);
  EXPECT_EQ(exact::sg_product(a, 0, b, 0).log_amplitude, 0);
  EXPECT_EQ(exact::sg_product(a, 0, b, 0).axis, a);
}

TEST(SgExact, LobeConversions) {
  for (const double k : {0.0, 1e-6, 1.0, 2.0, 1e5, 0x1p41}) {
    EXPECT_LE(std::abs(exact::toksvig_sharpness(exact::toksvig_complement(k)) - k),
              1e-15 * (1 + k) * (1 + k));
  }
  EXPECT_NEAR(1 - exact::toksvig_complement(2), 2 / 3.0, 1e-15);  // Lambert's mean direction
  EXPECT_NEAR(1 - exact::vmf_complement(2), 1 / std::tanh(2.0) - 0.5, 1e-15);
  EXPECT_NEAR(1 - exact::vmf_complement(0.01), 1 / std::tanh(0.01) - 100, 1e-12);
  // Banerjee's is right at both ends and 7 % off between.
  for (const double k : {0.01, 0.5, 2.0, 10.0, 1e3, 1e8}) {
    EXPECT_LT(relative(exact::banerjee_sharpness(exact::vmf_complement(k)), k),
              k < 0.1 || k > 100 ? 1e-2 : 0.1);
  }
}

TEST(SgExact, AsgProductIsTheSgProductForAnIsotropicOneThatIsSharp) {
  // Two planar Gaussians of bandwidths η and ν: π/(η+ν) exp(-ην/(η+ν) d²).
  const double value = exact::asg_product({3e-4, 4e-4, std::sqrt(1 - 25e-8)}, 2e7, 3e6, 3e6);
  EXPECT_LT(relative(value, kPi / 1.3e7 * std::exp(-3e6 * 1e7 / 1.3e7 * 25e-8)), 2e-7);
  EXPECT_EQ(exact::asg_product({0, 0.6, -0.8}, 1, 1, 1), 0);
}

TEST(SgQuadrature, ClampedCosineInClosedForm) {
  for (const double c : {-1.0, -0.3, 0.0, 0.8, 1.0}) EXPECT_NEAR(exact::clamped_cosine(c, 0), 0.25, 1e-13);
  for (const double k : {1e-6, 1.0, 8.0, 1e3, 1e12}) {
    // v = n: ∫₀¹ μ e^{κ(μ-1)} dμ / ∫₋₁¹ e^{κ(μ-1)} dμ.
    const double whole = -std::expm1(-2 * k) / k;
    const double up = k < 0.01 ? 0.5 - k / 6 : (1 - -std::expm1(-k) / k) / k;
    EXPECT_LT(relative(exact::clamped_cosine(1, k), up / whole), 1e-10) << k;
  }
  // L(v) - L(-v) = (v·n) times the mean cosine about the axis.
  for (const double k : {0.1, 1.0, 30.0, 1e3}) {
    for (const double c : {0.05, 0.4, 0.9999}) {
      const double difference = exact::clamped_cosine(c, k) - exact::clamped_cosine(-c, k);
      EXPECT_LT(relative(difference, c * (1 - exact::vmf_complement(k))), 1e-10) << c << " " << k;
    }
  }
}

TEST(SgQuadrature, AgreesWithTheIntegralAboutTheNormal) {
  for (const double k : {0.1, 1.0, 8.0, 64.0, 150.0}) {
    for (const double c : {-0.9, -0.2, 0.0, 0.03, 0.7}) {
      const double whole = exact::sg_integral(k);
      const double cosine = about_normal(c, k, [](double mu) { return mu; }) / whole;
      EXPECT_LT(relative(exact::clamped_cosine(c, k), cosine), 1e-9) << c << " " << k;
      const double hemisphere = about_normal(c, k, [](double) { return 1.0; });
      EXPECT_LT(relative(exact::hemispherical_integral(c, k), hemisphere), 1e-9) << c << " " << k;
    }
  }
}

TEST(SgQuadrature, SharpLobesNearTheHorizonAreAPlanarGaussians) {
  // With x = c√κ: √κ L → φ(x) + xΦ(x), as κ → ∞.
  for (const double k : {1e8, 1e10, 1e12}) {
    for (const double x : {-5.0, -1.0, 0.0, 0.5, 3.0}) {
      const double expected =
          std::exp(-x * x / 2) / std::sqrt(2 * kPi) + x * 0.5 * std::erfc(-x / std::sqrt(2.0));
      EXPECT_LT(relative(exact::clamped_cosine(x / std::sqrt(k), k) * std::sqrt(k), expected),
                30 / std::sqrt(k));
    }
  }
  EXPECT_EQ(exact::clamped_cosine(-1, 1e12), 0);
  EXPECT_NEAR(exact::clamped_cosine(0.25, 0x1p41), 0.25, 1e-10);
}

TEST(SgQuadrature, HemispheresAddUp) {
  for (const double k : {0.0, 1e-6, 0.3, 20.0, 1e6}) {
    for (const double c : {-1.0, -0.4, 0.0, 1e-4, 0.7}) {
      const double both = exact::hemispherical_integral(c, k) + exact::hemispherical_integral(-c, k);
      EXPECT_LT(relative(both, exact::sg_integral(k)), 1e-10) << c << " " << k;
      EXPECT_NEAR(exact::normalized_hemisphere(c, k) + exact::normalized_hemisphere(-c, k), 1, 1e-10);
    }
    EXPECT_NEAR(exact::normalized_hemisphere(1, k), 1, 1e-10);
    EXPECT_NEAR(exact::normalized_hemisphere(-1, k), 0, 1e-10);
  }
  // Against its definition where that doesn't cancel.
  const double k = 5, up = 2 * kPi * -std::expm1(-k) / k, low = up * std::exp(-k);
  const double s = (exact::hemispherical_integral(0.2, k) - low) / (up - low);
  EXPECT_NEAR(exact::normalized_hemisphere(0.2, k), s, 1e-10);
}

// Largest errors over 401 cosines of the formulas themselves, in double precision.
TEST(SgDiffuse, FormulasAreAsGoodAsPublished) {
  struct Row {
    double sharpness, pettineo_hill, meder_bruederlin, tokuyoshi2022, tokuyoshi2024;
  };
  for (const Row& row : {Row{0.1, 79, 1.2e-3, 2.6e-5, 1.5e-6}, Row{1, 2.0e-2, 8.7e-4, 2.1e-4, 3.7e-5},
                         Row{8, 1.6e-2, 1.1e-2, 3.3e-3, 1.2e-3}, Row{64, 9.9e-3, 8.8e-3, 2.3e-4, 6.5e-5},
                         Row{1024, 2.7e-3, 7.8e-3, 1.5e-4, 1.2e-6}, Row{1e6, 9e-5, 7.8e-3, 1.5e-4, 5e-12}}) {
    double worst[5] = {};
    for (int i = 0; i <= 400; ++i) {
      const double c = -1 + i / 200.0, expected = exact::clamped_cosine(c, row.sharpness);
      for (int m = 0; m < 5; ++m) {
        const double value = exact::diffuse_model(static_cast<exact::DiffuseModel>(m), c, row.sharpness);
        worst[m] = std::max(worst[m], std::abs(value - expected));
      }
    }
    EXPECT_LT(worst[1], row.pettineo_hill) << row.sharpness;
    EXPECT_LT(worst[2], row.meder_bruederlin) << row.sharpness;
    EXPECT_LT(worst[3], row.tokuyoshi2022) << row.sharpness;
    EXPECT_LT(worst[4], row.tokuyoshi2024) << row.sharpness;
  }
}

TEST(SgDiffuse, HemispheresAreAsGoodAsPublished) {
  for (const double k : {0.0, 0.01, 1.0, 10.0, 1e4}) {
    for (int i = 0; i <= 100; ++i) {
      const double c = -1 + i / 50.0, s = exact::normalized_hemisphere(c, k);
      EXPECT_NEAR(exact::logistic_hemisphere(c, k), s, 1.2e-2) << c << " " << k;
      EXPECT_NEAR(exact::gaussian_hemisphere(c, k), s, 6e-3) << c << " " << k;
    }
  }
}
