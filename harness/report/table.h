// A report as a table: one row a case.
#pragma once

#include <string>

#include "report/report.h"

namespace vsglbench {

// Columns: case, SMAPE %, RMSE, bias %, generate ms, frame ms; medians of times, means over seeds of errors.
// An error that is not above the reference's own noise is "≤ floor (VALUE)"; failed and skipped cases show
// their message.
std::string terminal_table(const Report& report);  // aligned, ends in a newline
std::string markdown_table(const Report& report);

}  // namespace vsglbench
