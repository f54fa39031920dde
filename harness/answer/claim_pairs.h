// Which cases of a report a claim compares, and the ratio of each pair.
#pragma once

#include <map>
#include <optional>

#include "answer/claims.h"

namespace vsglbench {

// A case of one side.
struct ClaimCase {
  const CaseResult* result;
  std::map<uint64_t, double> logs;  // of the metric, by seed
  std::optional<Estimate> ms;       // of the time that counts
};

struct Sides {
  std::vector<ClaimCase> a, b;
};

// Logarithms of a / b: by seed, of errors, and as an estimate with its interval.
struct PairRatio {
  std::map<uint64_t, double> by_seed;
  Estimate log;
};

bool is_time(const std::string& metric);  // "time:generate"

Sides sides_of(const Report& report, const PaperClaim& claim, const std::string& scene,
               const std::string& metric);
// `noise`: relative, of the time.
std::vector<PairRatio> pairs_of(const PaperClaim& claim, const Sides& sides, const std::string& metric,
                                double noise);

}  // namespace vsglbench
