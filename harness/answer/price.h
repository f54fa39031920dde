// What a knob costs: pairs of cases that differ in one parameter alone.
#pragma once

#include <string>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

// From one value of a parameter to the next: of numbers in their order, of words each against the first.
struct Price {
  std::string key, from, to;
  size_t before = 0, after = 0;        // indices in the group
  double error = 0, ms = 0;            // after - before
  Relation error_change, cost_change;  // of `after` beside `before`
  std::string pass;                    // whose median changes most; empty: none of both
  double pass_ms = 0;                  // by how much
  // Error bought for a millisecond: -error / ms. Nothing where the time does not differ.
  std::optional<double> error_per_ms() const;
};

// By key, then by the first point of each pair. `scene` and `method` are no knobs; two cases that differ in
// the presence of a parameter are no pair.
std::vector<Price> prices(const PointGroup& group);

// One line a key: over all its pairs, the geometric means of the ratios of errors and of times.
struct KnobSummary {
  std::string key;
  size_t pairs = 0;
  double error_ratio = 1, cost_ratio = 1;
  std::string pass;  // that pays most often
};
std::vector<KnobSummary> knob_summaries(const PointGroup& group, const std::vector<Price>& prices);

}  // namespace vsglbench
