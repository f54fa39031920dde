// What is being done at this moment: what a crash or a hang is blamed on.
#pragma once

#include <functional>
#include <string>

namespace vsglbench {

struct Activity {
  std::string case_id;  // empty: the harness's own work
  std::string action;   // "opening", "warm-up", "frame 3", "closing", …
  bool limited = true;  // may take no longer than Config::time_limit_s
};
using Announce = std::function<void(const Activity&)>;

}  // namespace vsglbench
