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
  std::string link;  // to the report, in Markdown, for a last note with its date and commit; empty: none
};

// Rows are named by what tells the cases apart; what all of them share is said below. One row a scene says
// what is noise: of errors, the reference's own floor; of times, the A/A pair's. Failed and skipped cases
// show their message. Throws Error(usage) for a column or part that is not there, or a glob that no case
// matches.
std::string terminal_table(const Report& report,
                           const TableOptions& options = {});  // aligned, ends in a newline
std::string markdown_table(const Report& report, const TableOptions& options = {});

}  // namespace vsglbench
