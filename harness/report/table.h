// A report as a table: one row a case.
#pragma once

#include <string>

#include "report/report.h"

namespace vsglbench {

// Columns: case, SMAPE %, RMSE, bias %, generate ms, frame ms; medians of times, means over seeds of errors.
// An error that is not above the reference's own noise is followed by "≤ floor VALUE".
// Where only generation was measured: case, both halves, G-buffer half and RSM half in ms, and the ratio of
// the first to that of the scene's first sound case, with its 95 % interval. Failed and skipped cases show
// their message.
std::string terminal_table(const Report& report);  // aligned, ends in a newline
std::string markdown_table(const Report& report);

}  // namespace vsglbench
