// A million random light and receiver pairs a model.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>

#include "operation/sg_random.h"

using namespace vsglbench;

TEST(SgMillionPairs, StayFinite) {
  Device device;
  for (const auto& model : exact::diffuse_model_names()) {
    const SgQuestion q{SgFunction::clamped_cosine, diffuse_model(model)};
    SgEvaluator evaluator(device, q);
    const SgAnswers a = evaluator.evaluate(random_rows(q, 1000000, 1));
    const ErrorSpread s = error_spread(q, a);
    fmt::print("{:<17} p50 {:.2e}  p99 {:.2e}  max {:.2e}\n", model, s.p50, s.p99, s.max);
    for (const float v : a.values) ASSERT_TRUE(std::isfinite(v)) << model;
    EXPECT_TRUE(s.impossible.empty() || model == "pettineo-hill") << model;
  }
}

TEST(SgMillionPairs, ProductsKeepTheirBound) {
  Device device;
  for (const SgFunction f : {SgFunction::integral, SgFunction::product, SgFunction::asg_product}) {
    const SgQuestion q{f};
    SgEvaluator evaluator(device, q);
    const ErrorSpread s = error_spread(q, evaluator.evaluate(random_rows(q, 1000000, 1)));
    fmt::print("{:<17} p50 {:.2e}  p99 {:.2e}  max {:.2e}\n", q.info().name, s.p50, s.p99, s.max);
    EXPECT_LE(s.max, 4e-6) << q.info().name;
    EXPECT_TRUE(s.impossible.empty()) << q.info().name;
  }
}

// A whole light at a whole surface.
TEST(SgMillionPairs, ShadingKeepsItsBound) {
  Device device;
  const SgQuestion q{SgFunction::shade};
  SgEvaluator evaluator(device, q);
  const std::vector<float> rows = random_rows(q, 1000000, 1);
  const SgAnswers a = evaluator.evaluate(rows);
  const ErrorSpread s = error_spread(q, a);
  fmt::print("{:<17} p50 {:.2e}  p99 {:.2e}  max {:.2e}\n", q.info().name, s.p50, s.p99, s.max);
  const auto row = [&](size_t i) {
    const auto columns = static_cast<ptrdiff_t>(q.info().columns.size());
    const auto from = rows.begin() + static_cast<ptrdiff_t>(i) * columns;
    return std::vector<float>(from, from + columns);
  };
  EXPECT_LE(s.max, 4e-6) << reproducer(q, row(s.worst));
  if (!s.impossible.empty()) ADD_FAILURE() << reproducer(q, shrink(evaluator, row(s.impossible[0])));
}
