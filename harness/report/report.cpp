#include "report/report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace vsglbench {

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

FluxResult flux_over_seeds(const std::vector<double>& ratios) {
  const MeanEstimate estimate = mean_ci95(ratios);
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return {estimate.mean, estimate.known ? std::optional(estimate.ci95) : std::nullopt, *least, *most};
}

std::optional<Summary> pass_time(const std::vector<PassTiming>& passes,
                                 const std::function<bool(const PassId&)>& wanted) {
  std::vector<double> sums;
  bool any = false;
  for (const PassTiming& pass : passes) {
    if (!wanted(pass.pass)) continue;
    if (any && pass.ms.samples.size() != sums.size()) {
      throw std::invalid_argument(
          fmt::format("pass {} has {} samples, not {}", pass.pass, pass.ms.samples.size(), sums.size()));
    }
    sums.resize(pass.ms.samples.size(), 0);
    for (size_t i = 0; i < sums.size(); ++i) sums[i] += pass.ms.samples[i];
    any = true;
  }
  if (!any) return std::nullopt;
  return summarize(std::move(sums));
}

std::optional<Summary> generate_time(const std::vector<PassTiming>& passes, std::optional<Half> half) {
  return pass_time(passes, [&](const PassId& pass) {
    return pass.stage == PassStage::generate && (!half || pass.half == half);
  });
}

std::optional<Summary> method_time(const std::vector<PassTiming>& passes) {
  return pass_time(passes, [](const PassId& pass) { return pass.stage != PassStage::draw; });
}

std::optional<Summary> stage_time(const std::vector<PassTiming>& passes, PassStage stage) {
  return pass_time(passes, [&](const PassId& pass) { return pass.stage == stage; });
}

FrameTiming frame_timing(std::vector<double> span_ms, const std::vector<PassTiming>& passes) {
  std::vector<double> sum(span_ms.size(), 0), rest = span_ms;
  for (const PassTiming& pass : passes) {
    if (pass.ms.samples.size() != span_ms.size()) {
      throw std::invalid_argument(fmt::format("pass {} has {} samples but there were {} frames", pass.pass,
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
  frame.method = method_time(passes);
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
