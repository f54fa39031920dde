// `analysis` of a report: per scene and metric the front, who is dominated by whom, errors at equal time,
// times at equal error, prices of knobs, and the error budget of the front's points.
#pragma once

#include "answer/point.h"

namespace vsglbench {

// Metrics that an analysis is made of, where cases have them.
const std::vector<std::string>& analysed_metrics();

// As report.schema.json says under `analysis`; null where no case has both an error and this time (a name of
// report/noise.h). Of 10,000 cases it takes about a second.
Json analysis_of(const Report& report, const std::string& time = "method");

}  // namespace vsglbench
