// Which cases of a report a claim compares, and the ratio of each pair.
#pragma once

#include <map>
#include <optional>

#include "answer/claims.h"

namespace vsglbench {

// A case of one side.
struct ClaimCase {
  const CaseResult* result;
  std::map<uint64_t, double>
      logs;                    // of the metric, by seed; of temporal.static, of a seed's distances to others
  std::optional<Estimate> ms;  // of the time that counts
  bool of_pairs = false;       // see mean_of_seeds
};

struct Sides {
  std::vector<ClaimCase> a, b;
};

// Logarithms of a / b: by seed, of errors, and as an estimate with its interval.
struct PairRatio {
  std::map<uint64_t, double> by_seed;
  Estimate log;
  bool of_pairs = false;  // see mean_of_seeds
};

// Their mean and Student's interval; nothing of fewer than two. `of_pairs`: of S distances to the others,
// each pair's is in two, and the interval is the jackknife's; two are the same, so that it takes three.
std::optional<Estimate> mean_of_seeds(const std::map<uint64_t, double>& logs, bool of_pairs);

Sides sides_of(const Report& report, const PaperClaim& claim, const std::string& scene,
               const std::string& metric);
// `noise`: relative, of the time.
std::vector<PairRatio> pairs_of(const PaperClaim& claim, const Sides& sides, const std::string& metric,
                                double noise);

}  // namespace vsglbench
