// Many reports of one machine beside each other: reports/dashboard/src/data.ts, History.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answer/compare.h"
#include "base/json.h"
#include "report/report.h"

namespace vsglbench {

// Takes reports one by one, in their order in time, and keeps of each its figures alone: hundreds of large
// reports fit.
class History {
 public:
  // Compares it with the one before. `file`: what the reader calls it.
  void add(const Report& report, const std::string& file);
  size_t size() const { return reports_.size(); }

  // Of many figures (kMostFigures) only the method's time and SMAPE stay; `notes` then says so.
  Json json(std::vector<std::string>* notes) const;

 private:
  struct Figures {  // of one case and column, by report
    std::map<size_t, Estimate> of;
  };
  struct Series {
    std::string scene, method, label;
    std::map<std::string, Figures> columns;  // by name of a time or a metric
    std::map<std::string, double> noise;     // by time: the largest A/A floor of all reports, relative
  };
  struct Step {
    size_t report = 0;
    std::string case_id, column;
    Change change = Change::same;
    Ratio ratio;
    std::optional<size_t> until = {};  // of what crept, from `report` on
  };

  void add_case(const CaseResult& c, const Report& report);
  void add_changes(const Comparison& comparison);
  bool persists(const Step& step) const;
  double noise_of_series(const Series& s, const std::string& column) const;
  std::vector<Step> creeping(const std::vector<std::string>& columns) const;
  void add_creeping(const std::string& id, const std::string& column, std::vector<Step>* out) const;

  std::vector<Json> reports_;
  std::vector<bool> other_kernels_;  // than the report before, or other in what the comparison refuses
  std::vector<std::string> ids_;     // of series, as they came
  std::map<std::string, Series> series_;
  std::vector<Step> steps_;
  std::optional<Report> last_;
};

}  // namespace vsglbench
