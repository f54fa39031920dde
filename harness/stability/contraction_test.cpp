// The SG library's stated bounds, whether or not the device may fuse and regroup arithmetic.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "operation/sg_evaluation.h"
#include "operation/sg_random.h"

using namespace vsglbench;

namespace {

Device& device() {
  static Device d;
  return d;
}

// Largest error of random rows with $VSGLBENCH_CONTRACTION = `contraction`; NaN where a value is impossible.
double largest_error(const SgQuestion& q, const char* contraction) {
  ::setenv("VSGLBENCH_CONTRACTION", contraction, 1);
  SgEvaluator evaluator(device(), q);
  const size_t count = q.function == SgFunction::receiver ? 200 : 20000;  // a cubature a row
  const ErrorSpread spread = error_spread(q, evaluator.evaluate(random_rows(q, count, 17)));
  ::unsetenv("VSGLBENCH_CONTRACTION");
  return spread.impossible.empty() ? spread.max : NAN;
}

// Rounding moves a largest error about; what leaves its bound grows by far more.
constexpr double kSlack = 1.3;

}  // namespace

TEST(Contraction, EveryOperationByItselfKeepsTheBounds) {
  for (const SgFunctionInfo& info : sg_functions()) {
    const SgQuestion q{sg_function(info.name), exact::DiffuseModel::tokuyoshi2024};
    EXPECT_LE(largest_error(q, "never"), kSlack * largest_error(q, "")) << info.name;
  }
}

// `precise` matters to two_sum() and two_product() of shaders/special.glsl, and so to what is compensated by
// them: lavapipe simplifies (a+b)-a where it may. Nothing else needs it to keep its bound.
TEST(Contraction, OnlyCompensatedSumsNeedPrecise) {
  for (const SgFunctionInfo& info : sg_functions()) {
    const SgQuestion q{sg_function(info.name), exact::DiffuseModel::tokuyoshi2024};
    const double with = largest_error(q, ""), without = largest_error(q, "always");
    fmt::print("{:<20} with precise {:.2e}, without {:.2e}\n", info.name, with, without);
    if (q.function == SgFunction::asg_product) {
      EXPECT_LT(with, 4e-7);
    } else {
      EXPECT_LE(without, kSlack * with) << info.name;
    }
  }
}

TEST(Contraction, DiffuseModelsKeepTheirErrors) {
  for (const auto model : {exact::DiffuseModel::meder_bruederlin, exact::DiffuseModel::tokuyoshi2022,
                           exact::DiffuseModel::tokuyoshi2024}) {
    const SgQuestion q{SgFunction::clamped_cosine, model};
    for (const char* contraction : {"never", "always"}) {
      EXPECT_LE(largest_error(q, contraction), kSlack * largest_error(q, "")) << q.model_name();
    }
  }
}
