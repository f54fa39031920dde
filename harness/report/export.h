// A report in the formats of other people's dashboards. Finite numbers only: what a case does not have is
// left out.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

//   bencher           Bencher Metric Format: benchmark → measure → value, lower_value, upper_value; times in
//   ns, as its
//                     `latency` is, errors in their own units
//   github-action     github-action-benchmark's customSmallerIsBetter: name, unit, value, range
//   google-benchmark  the shape that Google Benchmark's --benchmark_format=json has, one iteration run a case
std::vector<std::string> export_formats();
// Cases that are ok. Throws Error(usage) for an unknown format, naming the nearest.
Json export_report(const Report& report, const std::string& format);

}  // namespace vsglbench
