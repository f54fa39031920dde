// A report as a table: one row a case, or one across the values of a part of the cases' ids.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

struct TableOptions {
  std::vector<std::string> columns;  // names of report/columns.h; empty: all that any case has a number for
  std::vector<std::string> only;     // globs over case ids; empty: all cases
  // "method", "scene" or a key of the ids, such as "N": its values stand across, and a cell holds the numbers
  // of the columns, joined by " / ". Empty: one row a case.
  std::string across;
  // A column's name: within each scene the rows with the least first, with '-' before it the largest; those
  // without a number last. Empty: the report's order. Not with `across`.
  std::string sort;
  // Of a terminal table, in signs; 0: none. What does not differ from row to row is then said below, columns
  // are left out from the least important on until the rest fits, which is said, too, and then names are
  // shortened.
  size_t width = 0;
  std::string link;  // to the report, in Markdown, for a last note with its date and commit; empty: none
};

// Rows are named by what tells the cases apart; what all of them share is said below. One row a scene says
// what is noise: of errors, the reference's own floor; of times, the A/A pair's. Failed and skipped cases
// show their message. Throws Error(usage) for a column or part that is not there, or a glob that no case
// matches.
std::string terminal_table(const Report& report,
                           const TableOptions& options = {});  // aligned, ends in a newline
std::string markdown_table(const Report& report, const TableOptions& options = {});
// A row a case with its scene, id and status, and of every column the number and the ends of its interval, as
// many digits as they have; with `across`, the cells as they are.
std::string csv_table(const Report& report, const TableOptions& options = {});
// A tabular of the package booktabs; what is said below are comments.
std::string latex_table(const Report& report, const TableOptions& options = {});

}  // namespace vsglbench
