// The times of two reports beside each other: what compare.cpp asks for.
#pragma once

#include <vector>

#include "answer/compare.h"

namespace vsglbench {

struct CasePair {
  const CaseResult *base, *now;  // ok in both
};

// Fills passes, method_passes and times.
void compare_times_of(const Report& base, const Report& now, const std::vector<CasePair>& pairs,
                      const CompareOptions& options, Comparison* out);

}  // namespace vsglbench
