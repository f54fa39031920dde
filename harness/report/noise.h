// The times of a case under the names that a table's columns have, and what is noise in each.
#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace vsglbench {

// Names of times. The parts of a frame: "fixed", the raster of the two halves, the same for every method;
// "generate", both halves of light generation; "importance"; "visibility", shadow maps; "shade". Of those
// "generate.gbuffer" and "generate.rsm", either half of generation. Sums: "method", all passes but the fixed
// ones; "frame", the span of all passes. "rays": exact visibility, on the host.
const std::vector<std::string>& time_columns();

// Whether a pass counts in this time: `rays` has none.
bool counts_in(const std::string& column, const PassId& pass);

// ms of each frame; nothing when the case has no such time.
std::optional<Summary> time_of(const CaseResult& c, const std::string& column);

// ms of each frame that the passes take whose dotted name ("generate.rsm.sort") matches the glob, added up;
// nothing where none does.
std::optional<Summary> time_of_passes(const CaseResult& c, const std::string& glob);

// The time whose noise stands for that of such passes: "generate", "importance", "visibility" or "shade",
// where all that match in the scene's cases are parts of it, else "frame". The noise of a short pass may be
// larger.
std::string column_of_passes(const Report& report, const std::string& scene, const std::string& glob);

// The noise of every time of which both have samples above 0 only.
AaPair aa_pair(const CaseResult& original, const CaseResult& twin);

// A share as "4.2 %" or "340 %".
std::string percent(double share);

// Null where the scene has no A/A pair, or its pair not this time.
const TimeNoise* noise_of(const Report& report, const std::string& scene, const std::string& column);

// One line that names scene, time and noise where that is noisiest, if it is over `limit` (relative); or the
// first scene with a sound case and no A/A pair, whose noise nobody knows. Nothing: quiet enough.
std::optional<std::string> noise_over(const Report& report, double limit);

}  // namespace vsglbench
