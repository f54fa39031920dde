// A report as the dashboard shows it: reports/dashboard/src/data.ts, Report.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "report/report.h"

namespace vsglbench {

// `file`: what the reader calls it. Temporal entries have no picture yet (-1); claims are those of the
// programme's list that cases of the report tell.
Json digest_of(const Report& report, const std::string& file);

// --- its parts ---

// Groups of cases that can be compared, in the order of the report's cases: `of_case` has one entry a case,
// -1 where it has no error.
struct DigestGroups {
  Json list = Json::array();  // Group[]
  std::vector<int> of_case;
};
DigestGroups digest_groups(const Report& report);

// Cases of the report: one entry a case in every column.
Json digest_cases(const Report& report, const std::vector<int>& groups);

// Metrics that the report has, as Metric[].
Json digest_metrics(const Report& report);

// budgets[] and knobs[] of each group and metric, by the method's time.
struct DigestAnswers {
  Json budgets = Json::array(), knobs = Json::array();
};
DigestAnswers digest_answers(const Report& report, const DigestGroups& groups);

Json digest_temporal(const Report& report);
Json digest_claims(const Report& report);
// What `reproduce` found: papers.json. Throws Error(config) for another file.
Json digest_papers(const Json& papers, const std::string& file);

// Index of a scene in a report's list; -1: not there.
int scene_index(const Report& report, const std::string& name);
// Empty where the config has none.
std::string config_name(const Report& report);
// Methods in the order of the report's cases.
std::vector<std::string> methods_of(const Report& report);
// Passes of all cases in the frame's order: one that a case alone has stands after the one that comes before
// it there.
std::vector<std::string> pass_names(const Report& report);

}  // namespace vsglbench
