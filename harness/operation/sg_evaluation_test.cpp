// The GLSL of harness/shaders on the device against double precision: every bound that it states.
#include "operation/sg_evaluation.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/file.h"
#include "operation/sg_random.h"

using namespace vsglbench;
using exact::DiffuseModel;

namespace {

constexpr DiffuseModel kModels[] = {DiffuseModel::cosine, DiffuseModel::pettineo_hill,
                                    DiffuseModel::meder_bruederlin, DiffuseModel::tokuyoshi2022,
                                    DiffuseModel::tokuyoshi2024};

Device& device() {
  static Device d;
  return d;
}

const std::string& name(DiffuseModel model) {
  return exact::diffuse_model_names()[static_cast<size_t>(model)];
}

std::filesystem::path beside(const char* file) { return data_root() / "harness" / "operation" / file; }

// What the shaders' comments promise, in the measure that the function's error has.
double stated_bound(SgFunction f) {
  switch (f) {
    case SgFunction::integral:
      return 5e-7;
    case SgFunction::product:
      return 1e-6;
    case SgFunction::asg_product:
      return 2e-6;
    case SgFunction::toksvig_roundtrip:
      return 4e-7;
    case SgFunction::value:
      return 4e-7;
    case SgFunction::banerjee:
      return 4e-7;
    case SgFunction::vmf_complement:
      return 5e-7;
    case SgFunction::erf:
      return 4e-7;
    case SgFunction::erfc:
      return 1e-6;
    case SgFunction::expm1_over_x:
      return 4e-7;
    case SgFunction::exp:
      return 2e-7;
    case SgFunction::asg_product_shading:
      return 1e-6;
    default:
      return 0;
  }
}

ErrorSpread random_errors(const SgQuestion& q, size_t count, const std::filesystem::path& kernel = {}) {
  SgEvaluator evaluator(device(), q, kernel);
  return error_spread(q, evaluator.evaluate(random_rows(q, count, 2024)));
}

SgAnswers cosines(DiffuseModel model, float sharpness) {
  std::vector<float> rows;
  for (int i = 0; i <= 400; ++i) rows.insert(rows.end(), {-1 + static_cast<float>(i) / 200, sharpness});
  return SgEvaluator(device(), {SgFunction::clamped_cosine, model}).evaluate(rows);
}

// Rows of four arguments to sg_pixel_test.comp; three results a row.
std::vector<float> shade_rows(const Kernel& pixel, const std::vector<float>& rows) {
  const auto count = static_cast<uint32_t>(rows.size() / 4);
  Buffer in(device(), "arguments", rows.size() * sizeof(float)),
      out(device(), "values", count * 3 * sizeof(float));
  in.upload(std::span<const float>(rows));
  Recorder recorder(device());
  recorder.begin();
  recorder.pass({.step = "pixel"}, [&] { recorder.dispatch(pixel, {in, out}, count, 1); });
  recorder.submit_and_wait();
  return out.download<float>(3 * count);
}

}  // namespace

// Largest absolute error over 401 cosines: 1.3 times light-transport.md §4's table; at its ends, what the
// formula itself has there (sg_exact_test.cpp) or, where that is less, a rounding.
TEST(SgKernels, WithinTheTabledErrors) {
  struct Row {
    float sharpness;
    double pettineo_hill, meder_bruederlin, tokuyoshi2022, tokuyoshi2024;
  };
  const double none = std::numeric_limits<double>::infinity();
  for (const Row& row : {Row{0, none, 1.3e-3, 1e-6, 1e-6}, Row{1e-6f, none, 1.3e-3, 1e-6, 1e-6},
                         Row{0.1f, 79, 1.1e-3, 1.2e-4, 1.5e-6}, Row{1, 2.0e-2, 8.6e-4, 3.8e-4, 3.6e-5},
                         Row{8, 1.5e-2, 1.1e-2, 3.3e-3, 1.1e-3}, Row{64, 9.8e-3, 8.7e-3, 3.0e-4, 6.4e-5},
                         Row{1024, 2.6e-3, 7.7e-3, 2.8e-4, 1.2e-6}, Row{1e6f, 8.7e-5, 7.7e-3, 3.3e-4, 8e-8},
                         Row{0x1p41f, 1e-6, 7.7e-3, 3.3e-4, 8e-8}}) {
    const double bounds[] = {1, row.pettineo_hill, row.meder_bruederlin, row.tokuyoshi2022,
                             row.tokuyoshi2024};
    for (const DiffuseModel model : kModels) {
      if (model == DiffuseModel::pettineo_hill && row.sharpness < 1e-6f) continue;
      const SgAnswers a = cosines(model, row.sharpness);
      for (size_t i = 0; i < a.error.size(); ++i) {
        EXPECT_LE(a.error[i], 1.3 * bounds[static_cast<size_t>(model)])
            << name(model) << " cosine " << -1 + static_cast<double>(i) / 200 << " sharpness "
            << row.sharpness;
        if (model == DiffuseModel::pettineo_hill) continue;
        EXPECT_EQ(impossible({SgFunction::clamped_cosine, model}, a, i), "") << name(model) << " row " << i;
      }
    }
  }
}

// The formula, not another one that is as good: single against double precision of the same.
TEST(SgKernels, AreTheFormulas) {
  for (const DiffuseModel model : kModels) {
    for (const float sharpness : {0.01f, 1.0f, 8.0f, 300.0f, 1e5f}) {
      const SgAnswers a = cosines(model, sharpness);
      for (int i = 0; i <= 400; ++i) {
        const double formula = exact::diffuse_model(model, -1 + static_cast<float>(i) / 200, sharpness);
        const bool clamped = model != DiffuseModel::pettineo_hill;
        const double expected = clamped ? std::clamp(formula, 0.0, 1.0) : formula;
        // An α of 1182, or of 32, magnifies the roundings of two hemispherical integrals.
        const double bound = model == DiffuseModel::tokuyoshi2022      ? 2e-4
                             : model == DiffuseModel::meder_bruederlin ? 2e-5
                                                                       : 2e-6;
        EXPECT_NEAR(a.values[i], expected, bound * std::max(1.0, std::abs(expected)))
            << name(model) << " " << i << " " << sharpness;
      }
    }
  }
}

TEST(SgKernels, HemispheresAreTheFormulas) {
  for (const DiffuseModel model : {DiffuseModel::meder_bruederlin, DiffuseModel::tokuyoshi2022}) {
    const SgQuestion q{SgFunction::hemisphere, model};
    SgEvaluator evaluator(device(), q);
    const std::vector<float> rows = random_rows(q, 20000, 11);
    const SgAnswers a = evaluator.evaluate(rows);
    for (size_t i = 0; i < a.values.size(); ++i) {
      const double c = rows[2 * i], k = rows[2 * i + 1];
      const bool logistic = model == DiffuseModel::meder_bruederlin;
      const double formula = logistic ? exact::logistic_hemisphere(c, k) : exact::gaussian_hemisphere(c, k);
      ASSERT_NEAR(a.values[i], formula, 5e-7) << reproducer(q, {rows[2 * i], rows[2 * i + 1]});
    }
  }
}

TEST(SgKernels, RandomPairsStayFinite) {
  for (const DiffuseModel model : kModels) {
    const SgQuestion q{SgFunction::clamped_cosine, model};
    SgEvaluator evaluator(device(), q);
    const std::vector<float> rows = random_rows(q, 100000, 7);
    const SgAnswers a = evaluator.evaluate(rows);
    const ErrorSpread s = error_spread(q, a);
    fmt::print("{:<17} p50 {:.2e}  p99 {:.2e}  max {:.2e}\n", name(model), s.p50, s.p99, s.max);
    if (model == DiffuseModel::pettineo_hill) {
      for (const float v : a.values) ASSERT_TRUE(std::isfinite(v));
    } else {
      EXPECT_TRUE(s.impossible.empty())
          << reproducer(q, {rows[2 * s.impossible[0]], rows[2 * s.impossible[0] + 1]});
    }
  }
}

TEST(SgOperations, KeepTheirBounds) {
  for (const SgFunctionInfo& info : sg_functions()) {
    const SgQuestion q{sg_function(info.name)};
    if (stated_bound(q.function) == 0) continue;
    const ErrorSpread s = random_errors(q, 100000);
    fmt::print("{:<20} {:<31} p50 {:.2e}  p99 {:.2e}  max {:.2e}\n", info.name, error_name(info.error), s.p50,
               s.p99, s.max);
    EXPECT_LE(s.max, stated_bound(q.function)) << info.name;
    EXPECT_TRUE(s.impossible.empty()) << info.name;
  }
}

TEST(SgOperations, HemispheresAreWithinTheFormulasError) {
  for (const auto& [model, bound] :
       {std::pair(DiffuseModel::meder_bruederlin, 1.2e-2), std::pair(DiffuseModel::tokuyoshi2022, 6e-3)}) {
    const ErrorSpread s = random_errors({SgFunction::hemisphere, model}, 100000);
    fmt::print("hemisphere {:<17} p50 {:.2e}  p99 {:.2e}  max {:.2e}\n", name(model), s.p50, s.p99, s.max);
    EXPECT_LE(s.max, bound);
    EXPECT_TRUE(s.impossible.empty());
  }
}

TEST(SgOperations, AtTheEndsOfTheirDomains) {
  SgEvaluator integral(device(), {SgFunction::integral});
  EXPECT_NEAR(integral.evaluate(std::vector<float>{0}).values[0], 4 * std::numbers::pi, 1e-6);
  SgEvaluator product(device(), {SgFunction::product});
  // Opposite axes of one sharpness; two SGs that are 1 everywhere; one axis.
  const SgAnswers p = product.evaluate(std::vector<float>{-1, 0x1p41f, 0x1p41f, 0.3f, 0, 0, 1, 5, 7});
  EXPECT_LT(p.error[0], 1e-6);
  EXPECT_EQ(p.values[2], 0);
  EXPECT_EQ(p.values[3], 0);
  EXPECT_EQ(p.values[4], 0);
  EXPECT_NEAR(p.values[5], 12, 2e-6);
}

// What these tests would say of the textbook forms.
TEST(NaiveForms, BreakTheBounds) {
  const auto naive = beside("sg_naive.comp");
  for (const SgFunction f : {SgFunction::integral, SgFunction::product, SgFunction::value}) {
    const ErrorSpread s = random_errors({f}, 10000, naive);
    EXPECT_GT(s.max, 1e4 * stated_bound(f)) << SgQuestion{f}.info().name;
  }
  EXPECT_FALSE(random_errors({SgFunction::integral}, 10000, naive).impossible.empty());  // 0/0
}

TEST(Shrinking, LeavesAShortRowThatFailsStill) {
  for (const auto& [q, kernel] :
       {std::pair(SgQuestion{SgFunction::clamped_cosine, DiffuseModel::pettineo_hill},
                  std::filesystem::path()),
        std::pair(SgQuestion{SgFunction::product}, beside("sg_naive.comp"))}) {
    SgEvaluator evaluator(device(), q, kernel);
    const std::vector<float> rows = random_rows(q, 1000, 3);
    const SgAnswers a = evaluator.evaluate(rows);
    const ErrorSpread s = error_spread(q, a);
    ASSERT_FALSE(s.impossible.empty());
    const size_t columns = q.info().columns.size();
    const auto from = rows.begin() + static_cast<ptrdiff_t>(s.impossible[0] * columns);
    const std::vector<float> small = shrink(evaluator, {from, from + static_cast<ptrdiff_t>(columns)});
    EXPECT_EQ(out_of_domain(q, small), "");
    EXPECT_NE(impossible(q, evaluator.evaluate(small), 0), "");
    EXPECT_LT(fmt::format("{}", fmt::join(small, ",")).size(), 8 * columns);
  }
  EXPECT_EQ(reproducer({SgFunction::clamped_cosine, DiffuseModel::pettineo_hill}, {0.5f, 1e-6f}),
            "printf 'cosine,sharpness\\n0.5,1e-06\\n' | vsglbench sg --model pettineo-hill --function "
            "clamped_cosine");
}

// A texel by itself comes back with the sharpness it had: Banerjee's formula gives it from the mean length
// that the kernel made of it.
TEST(Pixels, ALoneTexelKeepsItsSharpness) {
  std::vector<float> rows;
  for (const float sharpness : {1e-3f, 0.1f, 0.5f, 0.99f, 1.0f, 2.0f, 2.2925f, 10.0f, 1e3f, 1e6f, 0x1p41f})
    rows.insert(rows.end(), {0.5f, sharpness, 1, 0.5f});
  KernelLibrary kernels(device());
  const auto values = shade_rows(kernels.get(beside("sg_pixel_test.comp"), {{"LOBE_CONVERSION", "1"}}), rows);
  for (size_t i = 0; i < rows.size() / 4; ++i) {
    const double sharpness = rows[4 * i + 1], back = exact::banerjee_sharpness(values[3 * i + 2]);
    EXPECT_LT(std::abs(back - sharpness), 1e-6 * (1 + sharpness)) << sharpness;
    if (sharpness != 2.2925f) continue;  // of the author's later code, whose mean length is this
    EXPECT_NEAR(1 - values[3 * i + 2], 0.5749, 5e-5);
  }
}

// DIFFUSE_MODEL, LOBE_CONVERSION and VARIANCE as the pixel sees them [MFIS16 App. B, C].
TEST(Pixels, FollowTheirSwitches) {
  const float cosine = 0.3f, distance = 2, variance = 0.5f, complement = 0.25f;
  for (const DiffuseModel model : kModels) {
    for (const int banerjee : {0, 1}) {
      for (const int disk : {0, 1}) {
        KernelLibrary kernels(device());
        const Kernel& pixel = kernels.get(beside("sg_pixel_test.comp"),
                                          {{"DIFFUSE_MODEL", std::to_string(static_cast<int>(model))},
                                           {"LOBE_CONVERSION", std::to_string(banerjee)},
                                           {"VARIANCE", std::to_string(disk)}});
        const auto values =
            shade_rows(pixel, {cosine, distance, variance, complement, cosine, 1000, 1e-20f, complement});
        const double lobe =
            banerjee ? exact::banerjee_sharpness(complement) : exact::toksvig_sharpness(complement);
        EXPECT_NEAR(values[1], lobe, 1e-5);
        // Light and lobe have one axis: their product is as sharp as both, with no loss of amplitude.
        const double sigma2 = disk ? variance / 2 : variance, sharpness = distance * distance / sigma2 + lobe;
        const double amplitude = 1 / exact::sg_integral(lobe) / (2 * std::numbers::pi * sigma2);
        const double expected = amplitude / std::numbers::pi * exact::sg_integral(sharpness) *
                                exact::diffuse_model(model, cosine, sharpness);
        EXPECT_NEAR(values[0] / expected, 1, model == DiffuseModel::tokuyoshi2022 ? 1e-3 : 1e-4)
            << name(model) << " " << banerjee << disk;
        // A point far away: its intensity cos θ/d², but for what the model misses at κ → ∞.
        const double point = 1 / exact::sg_integral(lobe) / std::numbers::pi * cosine / 1e6;
        const double missed = exact::diffuse_model(model, cosine, 0x1p41) / cosine;
        EXPECT_NEAR(values[3] / point, missed, 1e-3) << name(model) << " " << banerjee << disk;
      }
    }
  }
}
