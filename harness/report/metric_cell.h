// A metric as a table says it.
#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace vsglbench {

// The metric as its seeds judge it: a report of old may lack the median and range of heavy-tailed ones, or
// have them by another rule. As it is where the seeds or the value are missing.
MetricResult judged(const MetricResult& metric, Metric which, const std::vector<SeedResult>& seeds);

// "12.00 ± 0.35"; "3.10 ≤ floor 4.20" where it is not above `floor` (unscaled); of heavy-tailed seeds
// "-93.05 [-97.00 … +290.00]", median and range; "undefined", or "not measured" in a report of old. `format`
// is fmt's, for one number, which is the metric's times `scale`.
std::string metric_cell(const MetricResult& metric, double scale, const char* format,
                        std::optional<double> floor);

// So many significant digits, and never an exponent above 0: "0.00164", "1.64", "1640".
std::string significant(double v, int digits);

}  // namespace vsglbench
