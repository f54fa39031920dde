// What a reader must know of a table's numbers.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

// Settings, device and host, and what the times are worth. `shared`: what the ids of all its cases have in
// common; `link`: as TableOptions.
std::vector<std::string> table_notes(const Report& report, const std::string& shared,
                                     const std::string& link);

// Where a run's time went, in one line.
std::string wall_text(const WallTime& wall);

}  // namespace vsglbench
