// From errors of seeds to what a report says of a case.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/metric_cell.h"
#include "report/report.h"

namespace vsglbench {
namespace {

MetricResult named(Metric metric) {
  MetricResult result;
  result.formula = formula(metric).id;
  result.constants = formula(metric).constants;
  return result;
}

std::vector<double> values_of(Metric metric, const std::vector<SeedResult>& seeds) {
  std::vector<double> values;
  for (const SeedResult& s : seeds) {
    if (const auto v = s.errors.value(metric)) values.push_back(*v);
  }
  return values;
}

// How large a seed's value is: of bias, the energy it leaves, which like an error starts at 0.
double size_of(Metric metric, double value) { return std::abs(metric == Metric::bias ? 1 + value : value); }

void describe_spread(Metric metric, const std::vector<double>& values, MetricResult* result) {
  std::vector<double> sizes;
  for (const double v : values) sizes.push_back(size_of(metric, v));
  result->heavy_tailed = *std::max_element(sizes.begin(), sizes.end()) > kHeavyTail * median(sizes);
  result->median = result->least = result->largest = std::nullopt;
  if (!result->heavy_tailed) return;
  result->median = median(values);
  result->least = *std::min_element(values.begin(), values.end());
  result->largest = *std::max_element(values.begin(), values.end());
}

void estimate(Metric metric, const std::vector<double>& values, MetricResult* result) {
  const MeanEstimate mean = mean_ci95(values);
  result->value = mean.mean;
  if (mean.known) result->ci95 = mean.ci95;
  describe_spread(metric, values, result);
}

MetricResult over_seeds(Metric metric, const std::vector<SeedResult>& seeds) {
  MetricResult result = named(metric);
  const std::vector<double> values = values_of(metric, seeds);
  if (values.size() == seeds.size()) {
    estimate(metric, values, &result);
  } else {
    result.undefined = "the reference is black";
  }
  return result;
}

MetricResult flip_over_seeds(const std::vector<SeedResult>& seeds) {
  MetricResult result = named(Metric::flip);
  const std::vector<double> values = values_of(Metric::flip, seeds);
  result.constants["seeds"] = static_cast<double>(values.size());
  if (!values.empty()) {
    estimate(Metric::flip, values, &result);
  } else {
    result.undefined = seeds.front().errors.bias ? "it was not measured" : "the reference is black";
  }
  return result;
}

std::optional<double> mean_p99(const std::vector<SeedResult>& seeds) {
  double sum = 0, count = 0;
  for (const SeedResult& s : seeds) {
    if (!s.errors.flip_p99) continue;
    sum += *s.errors.flip_p99;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

// bias = X/R - 1, so that an error of R, relative to it, moves it by (1 + bias) times as much.
void widen(MetricResult* bias, const ReferenceInfo& reference) {
  if (!bias->value || !reference.standard_error || reference.batches.value_or(0) < 2) return;
  const double t = student_t95(static_cast<int>(*reference.batches) - 1);
  const double of_reference = t * *reference.standard_error * std::abs(1 + *bias->value);
  const double half = std::hypot(bias->ci95 ? bias->ci95->width() / 2 : 0, of_reference);
  bias->ci95 = Interval{*bias->value - half, *bias->value + half};
}

// Next to no light: a mean that is nobody's to divide by.
void undefine_relative(double light_ratio, Accuracy* a) {
  for (MetricResult* m : {&a->rrmse, &a->mrse, &a->bias, &a->smape_lit, &a->flip}) {
    const std::string formula = m->formula;
    const std::map<std::string, double> constants = m->constants;
    *m = {};
    m->formula = formula;
    m->constants = constants;
    m->undefined = fmt::format(
        "the reference is nearly black: its mean is {:.2g} of what the light's flux could give", light_ratio);
  }
  a->flip_p99.reset();
}

}  // namespace

MetricResult judged(const MetricResult& metric, Metric which, const std::vector<SeedResult>& seeds) {
  MetricResult out = metric;
  const std::vector<double> values = values_of(which, seeds);
  const bool all = which == Metric::flip || values.size() == seeds.size();  // flip is of some seeds alone
  if (metric.value && !values.empty() && all) describe_spread(which, values, &out);
  return out;
}

Accuracy accuracy_over_seeds(const std::vector<SeedResult>& seeds, const ReferenceInfo& reference) {
  if (seeds.empty())
    throw fail(ErrorKind::case_failed, "no seed was rendered; there is no accuracy to report");
  Accuracy a;
  a.smape = over_seeds(Metric::smape, seeds);
  a.rmse = over_seeds(Metric::rmse, seeds);
  a.rrmse = over_seeds(Metric::rrmse, seeds);
  a.mrse = over_seeds(Metric::mrse, seeds);
  a.bias = over_seeds(Metric::bias, seeds);
  widen(&a.bias, reference);
  a.smape_lit = over_seeds(Metric::smape_lit, seeds);
  a.flip = flip_over_seeds(seeds);
  a.flip_p99 = mean_p99(seeds);
  a.lit_share = seeds.front().errors.lit_share;
  if (reference.light_ratio && *reference.light_ratio < kNearlyBlack)
    undefine_relative(*reference.light_ratio, &a);
  a.reference = reference;
  a.pixels = seeds.front().errors.pixels;
  a.below_floor = *a.smape.value <= reference.noise_floor_smape;
  return a;
}

}  // namespace vsglbench
