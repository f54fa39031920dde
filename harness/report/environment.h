// The machine and the source that a report comes from.
#pragma once

#include "report/report.h"

namespace vsglbench {

HostInfo host_info();  // "unknown" or 0 for what the system does not tell
// Mean number of runnable processes over the last minute (1-minute load average); nothing where the system
// does not tell.
std::optional<double> load_average();
GitState build_git();  // of the source tree, taken when it was built

}  // namespace vsglbench
