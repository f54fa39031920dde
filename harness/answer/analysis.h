// `analysis` of a report: per scene and metric the front, who is dominated by whom, errors at equal time,
// times at equal error, prices of knobs, and the error budget of the front's points.
#pragma once

#include "answer/point.h"

namespace vsglbench {

// Metrics that an analysis is made of, where cases have them.
const std::vector<std::string>& analysed_metrics();

// As analysis.schema.json says; an empty list where no case has both error and time.
Json analysis_of(const Report& report, const std::string& time = "method");

}  // namespace vsglbench
