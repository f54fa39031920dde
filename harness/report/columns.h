// The columns of a report's table, as a list.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

struct Column {
  std::string name, head;  // name: as `vsglbench table --columns` takes it
  // The cell of an ok case, beside the first one of its scene. Empty where the case has no such number.
  using Cell = std::function<std::string(const CaseResult& c, const CaseResult& first)>;
  Cell cell;    // with its interval
  Cell number;  // without
  // The number itself and its interval, in the unit of the cell; nothing where the case has none.
  std::function<std::optional<double>(const CaseResult& c, const CaseResult& first)> value;
  std::function<std::optional<Interval>(const CaseResult& c, const CaseResult& first)> interval;
  // What is noise in this column and scene, as text; empty where that is not known.
  std::function<std::string(const Report& report, const std::string& scene)> floor;
  bool on_request = false;  // stands in a table only where it is named
};

// "4.2", or "4.2 … 7.1" where values differ; empty for none.
std::string range_of(const std::vector<double>& values);

// The columns that only scenes in motion have.
inline constexpr const char* kTemporalColumns[] = {"flicker", "static_flicker", "detail", "gain"};

// Columns for whole frames: errors are means over seeds, and one that is not above the reference's own noise
// is followed by "≤ floor VALUE"; times are medians in ms.
const std::vector<Column>& frame_columns();
// Where only generation was measured: times of both halves and of either, and their ratio to the scene's
// first sound case.
const std::vector<Column>& generation_columns();

}  // namespace vsglbench
