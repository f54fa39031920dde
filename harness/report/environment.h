// The machine and the source that a report comes from.
#pragma once

#include "report/report.h"

namespace vsglbench {

HostInfo host_info();  // "unknown" or 0 for what the system does not tell
GitState build_git();  // of the source tree, taken when it was built

}  // namespace vsglbench
