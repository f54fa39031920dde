// What a case that is not finished has shown so far: enough for another process to go on with it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "report/report.h"

namespace vsglbench {

// A case whose seeds are rendered and measured, and whose images are on the disk: all but its times.
struct ScoredCase {
  CaseResult result;
  std::vector<double> rays_ms;  // FrameTiming::host_visibility
};

struct CaseProgress {
  std::optional<ScoredCase> scored;
  std::vector<FrameTimes> frames;  // timed, in their order
};
using Progresses = std::map<std::string, CaseProgress>;  // by case id

}  // namespace vsglbench
