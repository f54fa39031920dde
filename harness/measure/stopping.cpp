#include "measure/stopping.h"

#include <bit>

#include "measure/statistics.h"

namespace vsglbench {

std::string_view name(StopReason reason) {
  switch (reason) {
    case StopReason::converged:
      return "converged";
    case StopReason::time_limit:
      return "time_limit";
    case StopReason::max_samples:
      return "max_samples";
  }
  return "";
}

bool looks_at(size_t samples) { return samples >= 8 && std::has_single_bit(samples); }

std::optional<StopReason> should_stop(const StoppingRule& rule, std::span<const double> samples,
                                      double elapsed_s) {
  if (samples.empty()) return std::nullopt;
  if (looks_at(samples.size()) && samples.size() >= rule.min_samples &&
      median_ci95(samples).width() < rule.relative_width * median(samples)) {
    return StopReason::converged;
  }
  if (samples.size() >= rule.max_samples) return StopReason::max_samples;
  if (elapsed_s >= rule.time_limit_s) return StopReason::time_limit;
  return std::nullopt;
}

}  // namespace vsglbench
