// What papers claim of errors, flicker and times, tried on a report. The claims are data: claims.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

// What a claim says of the ratio a / b.
enum class Says { less, no_more, more };

struct PaperClaim {
  std::string name, text, source;  // source: paper and place
  // Settings that a case must have to be one of each side, "method" or parameters, each a value or a list.
  // What neither side names is the same in both cases of a pair, as far as both have it.
  Json both, a, b;
  // A parameter of numbers: a has one of its values and b the next smaller that the report has in a case
  // alike in all else, so that a list 1, 2, 4 makes two pairs. Empty: none.
  std::string step;
  Says says = Says::less;
  double factor = 1;  // of the ratio: "less" than that
  bool equal_time =
      false;  // b's error is read off its cases over N, at a's time, in log-log; else N is the same
  // Errors of image/metrics.h, flip_p99, p99_9; of how the lights lie on the RSM (report/coverage.h) overlap,
  // gap, pdf_overlap, pdf_gap, kernel_largest, kernel_over; detail, spikes and
  // cancellation_rate of report.h's SeedResult, "region." and rmse, smape or detail; "temporal." and
  // derivative, static or detail; "time:" and a time of report/noise.h; "time:pass:" and a glob of passes'
  // dotted names, of which the sum counts.
  std::vector<std::string> metrics;
  std::vector<std::string> scenes;  // globs
};

// holds          the pairs' mean ratio is as said, beyond its 95 % interval and the least effect, and no pair
// contradicts does_not_hold  it is not, as surely, and no pair is as said in_part        some pairs are
// surely as said, others surely not
enum class Ruling { holds, does_not_hold, in_part, undecided, not_run };
std::string_view name(Ruling ruling);

struct ClaimRow {
  std::string scene, metric;
  Ruling ruling = Ruling::not_run;
  std::string why;  // not run or undecided: what is missing
  size_t pairs = 0, holding = 0, contrary = 0;
  double ratio = 1;                // a / b: geometric mean over pairs and seeds
  Interval ci95;                   // of it, over seeds; of times, over frames
  double lowest = 1, highest = 1;  // of a pair
};

struct TriedClaim {
  PaperClaim claim;
  std::vector<ClaimRow> rows;  // by scene, in the report's order, and metric
};

// Throws Error(config) "FILE:LINE: ...". Without a path: the list that comes with the programme.
std::vector<PaperClaim> load_claims(const std::filesystem::path& file = {});

// "fis|mfis K=1", as a person would say which cases these are.
std::string settings_text(const Json& settings);

// What is compared, and what is said: "fis|mfis K=1 beside vpl, at equal N; the ratio must be below 1".
std::string comparison_text(const PaperClaim& claim);

TriedClaim try_claim(const Report& report, const PaperClaim& claim);

std::string claims_text(const Report& report, const std::vector<TriedClaim>& claims, bool markdown);

}  // namespace vsglbench
