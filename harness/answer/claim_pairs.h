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

bool is_time(const std::string& metric);  // "time:generate", "time:pass:generate.rsm.sum*"
// "generate.rsm.sum*" of the second; nothing of other metrics.
std::optional<std::string> pass_glob(const std::string& metric);
// ms that such a metric is of; nothing where the case has no such time.
std::optional<Summary> claimed_time(const CaseResult& c, const std::string& metric);
// Relative; of the A/A pair's time that it is part of, and 0 where that is not known. Of what is no time,
// that of the method, by which equal times are told.
double claimed_noise(const Report& report, const std::string& scene, const std::string& metric);
bool is_temporal(const std::string& metric);  // "temporal.static"

// Their mean and Student's interval; nothing of fewer than two. `of_pairs`: of S distances to the others,
// each pair's is in two, and the interval is the jackknife's; two are the same, so that it takes three.
std::optional<Estimate> mean_of_seeds(const std::map<uint64_t, double>& logs, bool of_pairs);

Sides sides_of(const Report& report, const PaperClaim& claim, const std::string& scene,
               const std::string& metric);
// `noise`: relative, of the time.
std::vector<PairRatio> pairs_of(const PaperClaim& claim, const Sides& sides, const std::string& metric,
                                double noise);

}  // namespace vsglbench
