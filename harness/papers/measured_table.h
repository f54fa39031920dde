// A published table beside what is measured here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "papers/exhibit.h"
#include "report/report.h"

namespace vsglbench {

// A pass that a row adds up.
struct MeasuredPass {
  std::string name;
  double mean_ms = 0;  // over frames: means add up where medians need not
};

struct MeasuredRow {
  std::string column, name, published;
  bool sum = false;
  std::optional<double> value;   // median over frames, ms; of code size a count
  std::optional<Interval> ci95;  // of the median; none of a count
  double mean = 0;
  std::vector<MeasuredPass> passes;  // empty where the case has none of them
};

// The table of one scene; of code size, of none.
struct MeasuredTable {
  std::string scene, unit;
  std::vector<MeasuredRow> rows;  // column by column
};

// One table for each scene of the report that has an ok case of every column that is of it. A column that
// several cases of a scene match throws Error(config).
std::vector<MeasuredTable> tables_of(const Report& report, const Exhibit& exhibit);

// Of Tab. 3; `sizes` is what `code-size --json` prints.
MeasuredTable code_size_table_of(const Json& sizes, const Exhibit& exhibit);

// "3.004" as a number. Throws Error(config) for text that is none.
double published_value(const std::string& text);

}  // namespace vsglbench
