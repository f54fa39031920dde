// What a reader must know of the errors of a scene's cases, one sentence each.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

// A reference that is nearly black (kNearlyBlack) or lit in fewer than 1 % of its pixels; and pairs of
// methods that SMAPE and RMSE rank differently: in both metrics the two differ by more than the reference's
// floor and their intervals (their ranges, where seeds are heavy-tailed) do not meet. Cases without accuracy,
// and pairs with different references, are left out.
std::vector<std::string> accuracy_notes(const std::vector<CaseResult>& cases, const std::string& scene);

}  // namespace vsglbench
