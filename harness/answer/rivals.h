// `vsglbench answer --method`: one method against all others of a report, scene by scene.
#pragma once

#include <string>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

// How a method's points stand by one metric in one group: points as in front.h, which of its points another
// method's dominates, and by how much it errs at equal time.
struct Rivalry {
  std::string scene, visibility, reference, metric;  // as in PointGroup
  size_t undominated = 0;                            // no point of another method may dominate them
  std::vector<std::string>
      ambiguous;  // "N=64 by mfis N=256": better by the estimates, not beyond the intervals
  std::vector<std::string> dominated;  // the same, beyond the intervals and the A/A noise
  // Error of each of its points over that of the papers' VSGL methods at equal time, read off their staircase
  // in log-log; points that none of theirs lies on either side of are left out. Those are the cases of other
  // methods with `shading` vsgl14 or vsgl16, but for all-texels.
  std::vector<double> at_equal_time;
};

struct RivalQuestion {
  std::string method;
  std::vector<std::string> metrics = {"rmse", "flip"};
  std::string time = "method";
  std::string scene, visibility;  // empty: all
};

// Every group of the report that has the method and is asked for, metric by metric. Throws Error(usage) where
// there is none, naming the nearest method or scene, or where the report lacks a metric or the time.
std::vector<Rivalry> rivalries(const Report& report, const RivalQuestion& question);

// A table of Markdown, a row a group: a count of each kind for each metric, and the geometric mean and range
// at equal time by the first metric. Then a line for each dominated point, and for each that can't be told.
std::string rivalry_table(const std::vector<Rivalry>& rivalries);

}  // namespace vsglbench
