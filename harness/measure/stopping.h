// When a measurement has enough samples.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace vsglbench {

struct StoppingRule {
  double relative_width = 0.02;  // of the median's 95 % interval, in units of the median
  size_t min_samples = 10, max_samples = 256;
  double time_limit_s = 10;  // wall time spent on this case; holds even below min_samples
};

enum class StopReason { converged, time_limit, max_samples };
std::string_view name(StopReason reason);  // "converged", "time_limit", "max_samples"

// Whether the interval is looked at after so many samples: 8, 16, 32, … By doubled counts 0.947 of the
// intervals of median_ci95() at least hold the median, as stopping_test counts; a rule that looks after every
// sample ends at the luckiest moment, which leaves down to 0.938.
bool looks_at(size_t samples);

// Nothing while more samples are wanted. In this order: no sample yet → go on; looked at, interval under the
// wanted width and min_samples reached → converged; max_samples reached; time limit reached.
std::optional<StopReason> should_stop(const StoppingRule& rule, std::span<const double> samples,
                                      double elapsed_s);

}  // namespace vsglbench
