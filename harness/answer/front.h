// The Pareto front of a group of points: those that no other point beats in both time and error.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

// What a point is to the front of its group.
//   front      no other point has both less time and less error, by their estimates
//   dominated  a point of the front is better on one axis and better or the same on the other, beyond the
//   intervals ambiguous  a point of the front is better by the estimates, but the intervals can't tell
enum class Standing { front, dominated, ambiguous };
std::string_view name(Standing standing);

struct Placed {
  size_t point = 0;  // index in the group
  Standing standing = Standing::front;
  std::vector<size_t> by;  // points of the front that dominate it, or could; by time
};

// One entry a point, in the group's order.
std::vector<Placed> place(const PointGroup& group);
// The front's points by time, errors falling.
std::vector<size_t> front_of(const PointGroup& group);
// The lower left staircase of some of the group's points, given by index.
std::vector<size_t> staircase(const PointGroup& group, const std::vector<size_t>& points);

// Of some points, those whose time can't be told from the cheapest's (intervals and the A/A noise), and those
// whose error can't be told from the least; as the points are ordered.
std::vector<size_t> as_cheap(const PointGroup& group, const std::vector<size_t>& points);
std::vector<size_t> as_exact(const PointGroup& group, const std::vector<size_t>& points);
// What is named for the cheapest: of those as cheap, the most exact. For the most exact: of those as exact,
// the cheapest. Never one that another of the points beats in both by the estimates. `points`: at least one.
size_t cheapest_of(const PointGroup& group, const std::vector<size_t>& points);
size_t most_exact_of(const PointGroup& group, const std::vector<size_t>& points);

// Straight in log-log between neighbours of a staircase; nothing outside of it: no point is made up that was
// not measured on both sides.
std::optional<double> error_at(const PointGroup& group, const std::vector<size_t>& stairs, double ms);
std::optional<double> time_to_reach(const PointGroup& group, const std::vector<size_t>& stairs, double error);
// The two neighbours that the latter lies between; twice the same where a point has that error.
std::optional<std::pair<size_t, size_t>> around_error(const PointGroup& group,
                                                      const std::vector<size_t>& stairs, double error);

}  // namespace vsglbench
