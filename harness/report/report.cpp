#include "report/report.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace vsglbench {
namespace {

MetricResult over_seeds(Metric metric, const std::vector<SeedResult>& seeds) {
  MetricResult result;
  result.formula = formula(metric).id;
  result.constants = formula(metric).constants;
  std::vector<double> values;
  for (const SeedResult& s : seeds) {
    if (const auto v = s.errors.value(metric)) values.push_back(*v);
  }
  if (values.size() != seeds.size()) {
    result.undefined = "the reference is black";
    return result;
  }
  const MeanEstimate mean = mean_ci95(values);
  result.value = mean.mean;
  if (mean.known) result.ci95 = mean.ci95;
  return result;
}

// bias = X/R - 1, so that an error of R, relative to it, moves it by (1 + bias) times as much.
void widen(MetricResult* bias, const ReferenceInfo& reference) {
  if (!bias->value || reference.batches < 2) return;
  const double of_reference = student_t95(static_cast<int>(reference.batches) - 1) * reference.standard_error *
                              std::abs(1 + *bias->value);
  const double half = std::hypot(bias->ci95 ? bias->ci95->width() / 2 : 0, of_reference);
  bias->ci95 = Interval{*bias->value - half, *bias->value + half};
}

bool starts_with_any(const std::string& name, const std::vector<std::string>& prefixes) {
  for (const auto& p : prefixes) {
    if (name == p || (p.ends_with('.') && name.starts_with(p))) return true;
  }
  return false;
}

}  // namespace

std::string_view name(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::failed:
      return "failed";
    case Status::skipped:
      return "skipped";
  }
  return "";
}

std::string_view name(Measure measure) { return measure == Measure::frame ? "frame" : "generation"; }

HealthReport health_report(const Health& health, const std::string& first_bad_pass) {
  HealthReport out{health.nan, health.inf, health.negative, std::nullopt};
  if (health.first_bad) out.first_bad = FirstBad{first_bad_pass, *health.first_bad, std::nullopt};
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
  a.reference = reference;
  a.pixels = seeds.front().errors.pixels;
  a.below_floor = *a.smape.value <= reference.noise_floor_smape;
  return a;
}

std::optional<Summary> sum_of_passes(const std::vector<PassTiming>& passes,
                                     const std::vector<std::string>& prefixes) {
  std::vector<double> sums;
  bool any = false;
  for (const PassTiming& pass : passes) {
    if (!starts_with_any(pass.name, prefixes)) continue;
    if (any && pass.ms.samples.size() != sums.size()) {
      throw std::invalid_argument(
          fmt::format("pass {} has {} samples, not {}", pass.name, pass.ms.samples.size(), sums.size()));
    }
    sums.resize(pass.ms.samples.size(), 0);
    for (size_t i = 0; i < sums.size(); ++i) sums[i] += pass.ms.samples[i];
    any = true;
  }
  if (!any) return std::nullopt;
  return summarize(std::move(sums));
}

FrameTiming frame_timing(std::vector<double> span_ms, const std::vector<PassTiming>& passes) {
  std::vector<double> sum(span_ms.size(), 0), rest = span_ms;
  for (const PassTiming& pass : passes) {
    if (pass.ms.samples.size() != span_ms.size()) {
      throw std::invalid_argument(fmt::format("pass {} has {} samples but there were {} frames", pass.name,
                                              pass.ms.samples.size(), span_ms.size()));
    }
    for (size_t i = 0; i < sum.size(); ++i) {
      sum[i] += pass.ms.samples[i];
      rest[i] -= pass.ms.samples[i];
    }
  }
  FrameTiming frame;
  frame.span = summarize(std::move(span_ms));
  frame.sum_ms = median(sum);
  frame.unattributed_ms = median(rest);
  return frame;
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace vsglbench
