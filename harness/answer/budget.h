// Where a case's error comes from, by switching one approximation at a time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

// One step from the reference to the case. Errors of metrics don't add up in general: an increment is what
// the metric rises by when this approximation joins those above it, and may be below 0.
//   RSM resolution   all-texels with exact BRDFs, without occlusion, against the reference without it
//   SG lobes         all-texels shaded as the case is, with all keys of it, beside that
//   clustering       the case itself without occlusion, beside that: fewer lights than texels
//   visibility test  the case with exact visibility against the full reference, beside that: one ray a light
//   shadow maps      the case as it is, beside that
struct BudgetPart {
  std::string name;
  std::string case_id;  // that has this error; empty: no such case in the report
  std::string missing;  // what would have to be run; empty: there
  std::optional<Estimate> error;
  // Over the nearest part above that is there; of the first, its error. Absent where no part above is there:
  // what of the error is whose can't be told then.
  std::optional<double> increment;
};

struct Budget {
  std::string case_id;
  std::vector<BudgetPart> parts;  // those that apply to the case
  std::optional<double>
      flux_lost;  // 1 - Σ light power / Σ texel power; below 0: gained. Absent: not measured
};

// Throws Error(usage) for a case without the metric.
Budget error_budget(const Report& report, const CaseResult& c, const AnswerOptions& options = {});

}  // namespace vsglbench
