// What the papers claim, tried in one place: a scene of a run, a figure, the lights of a case, the code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answer/claims.h"
#include "figure/drawing.h"
#include "papers/exhibit.h"
#include "run/lights_run.h"

namespace vsglbench {

// One row of the ledger. Exhibit, claim, place and metric together name it.
struct ClaimTrial {
  std::string exhibit, claim;  // claim: a name of claims.json, "sgl22-1/2", "code-size/lines"
  std::string text, source;    // paraphrase; paper and place
  std::string how;             // "mfis beside fis K=1; the ratio must be below 1"
  std::string place, metric;   // "conference", "rmse"
  Ruling ruling = Ruling::not_run;
  std::optional<double> ratio;   // of a ratio that is compared
  std::optional<Interval> ci95;  // of the ratio
  std::string figures;           // what else shows it, or why it was not run
};

// Claims that cases of a report tell, for the names of the exhibit. A claim that has no case there gives one
// row `not_run`.
std::vector<ClaimTrial> trials_of(const Report& report, const Exhibit& exhibit,
                                  const std::vector<PaperClaim>& claims);
// Those that a figure checks by itself.
std::vector<ClaimTrial> trials_of(const DrawnFigure& figure, const Exhibit& exhibit);
// [MFIS16 §5, Tab. 3] of code size: what `code-size --json` prints.
std::vector<ClaimTrial> trials_of_code_size(const Json& sizes, const Exhibit& exhibit);
// [VSGL14 §3.2, Fig. 2] of lights on discontinuous geometry.
std::vector<ClaimTrial> trials_of(const std::vector<LightsResult>& lights, const Exhibit& exhibit);

Json to_json(const ClaimTrial& trial);
// Throws Json::exception for what is no trial.
ClaimTrial trial_from_json(const Json& json);

// A ruling by its name; nothing for another text.
std::optional<Ruling> ruling_named(const std::string& text);

}  // namespace vsglbench
