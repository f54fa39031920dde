// Pareto dominance under uncertainty, by intervals; interpolation on staircases.
#include "answer/front.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace vsglbench {
namespace {

bool dominates(const PointGroup& g, const Point& a, const Point& b) {
  const Relation error = compare_errors(a, b), cost = compare_costs(a, b, g.noise);
  const auto no_worse = [](Relation r) { return r == Relation::better || r == Relation::same; };
  return no_worse(error) && no_worse(cost) && (error == Relation::better || cost == Relation::better);
}

// y at x on the line through two points, all in logarithms; nothing where an error of 0 has none.
std::optional<double> between(double x0, double y0, double x1, double y1, double x) {
  if (std::min({x0, y0, x1, y1}) <= 0) return std::nullopt;
  const double t = (std::log(x) - std::log(x0)) / (std::log(x1) - std::log(x0));
  return std::exp(std::log(y0) + t * (std::log(y1) - std::log(y0)));
}

auto time_in(const PointGroup& g) {
  return [&g](size_t i) { return std::pair(g.points[i].ms.value, g.points[i].error.value); };
}

auto error_in(const PointGroup& g) {
  return [&g](size_t i) { return std::pair(g.points[i].error.value, g.points[i].ms.value); };
}

}  // namespace

std::string_view name(Standing standing) {
  switch (standing) {
    case Standing::front:
      return "front";
    case Standing::dominated:
      return "dominated";
    case Standing::ambiguous:
      return "ambiguous";
  }
  throw std::logic_error("no such standing");
}

std::vector<size_t> staircase(const PointGroup& group, const std::vector<size_t>& points) {
  std::vector<size_t> order = points;
  std::ranges::stable_sort(order, {}, time_in(group));
  std::vector<size_t> stairs;
  double least = std::numeric_limits<double>::infinity();
  for (const size_t i : order) {
    if (group.points[i].error.value >= least) continue;
    least = group.points[i].error.value;
    stairs.push_back(i);
  }
  return stairs;
}

std::vector<size_t> front_of(const PointGroup& group) {
  std::vector<size_t> all(group.points.size());
  std::iota(all.begin(), all.end(), size_t{0});
  return staircase(group, all);
}

std::vector<Placed> place(const PointGroup& group) {
  const std::vector<size_t> front = front_of(group);
  std::vector<Placed> out;
  for (size_t i = 0; i < group.points.size(); ++i) {
    Placed placed{i, Standing::front, {}};
    if (std::ranges::count(front, i) == 0) {
      std::vector<size_t> sure, maybe;
      for (const size_t f : front) {
        const Point &a = group.points[f], &b = group.points[i];
        if (dominates(group, a, b)) sure.push_back(f);
        if (a.ms.value <= b.ms.value && a.error.value <= b.error.value) maybe.push_back(f);
      }
      placed.standing = sure.empty() ? Standing::ambiguous : Standing::dominated;
      placed.by = sure.empty() ? maybe : sure;
    }
    out.push_back(std::move(placed));
  }
  return out;
}

namespace {

// Those of `chosen` that no other of the points is before in both by the estimates. Wide intervals hold much;
// what another is both cheaper and more exact than is not advised.
std::vector<size_t> of_stairs(const PointGroup& group, const std::vector<size_t>& points,
                              const std::vector<size_t>& chosen) {
  std::vector<size_t> out;
  for (const size_t i : staircase(group, points)) {
    if (std::ranges::count(chosen, i) > 0) out.push_back(i);
  }
  return out;
}

}  // namespace

std::vector<size_t> as_cheap(const PointGroup& group, const std::vector<size_t>& points) {
  const Point& cheapest = group.points[*std::ranges::min_element(points, {}, time_in(group))];
  std::vector<size_t> out;
  std::ranges::copy_if(points, std::back_inserter(out), [&](size_t i) {
    return compare_costs(group.points[i], cheapest, group.noise) != Relation::worse;
  });
  return out;
}

std::vector<size_t> as_exact(const PointGroup& group, const std::vector<size_t>& points) {
  const Point& least = group.points[*std::ranges::min_element(points, {}, error_in(group))];
  std::vector<size_t> out;
  std::ranges::copy_if(points, std::back_inserter(out),
                       [&](size_t i) { return compare_errors(group.points[i], least) != Relation::worse; });
  return out;
}

size_t cheapest_of(const PointGroup& group, const std::vector<size_t>& points) {
  return std::ranges::min(of_stairs(group, points, as_cheap(group, points)), {}, error_in(group));
}

size_t most_exact_of(const PointGroup& group, const std::vector<size_t>& points) {
  return std::ranges::min(of_stairs(group, points, as_exact(group, points)), {}, time_in(group));
}

std::optional<double> error_at(const PointGroup& group, const std::vector<size_t>& stairs, double ms) {
  for (size_t k = 0; k < stairs.size(); ++k) {
    const Point& right = group.points[stairs[k]];
    if (right.ms.value == ms) return right.error.value;
    if (right.ms.value < ms) continue;
    if (k == 0) return std::nullopt;
    const Point& left = group.points[stairs[k - 1]];
    return between(left.ms.value, left.error.value, right.ms.value, right.error.value, ms);
  }
  return std::nullopt;
}

std::optional<std::pair<size_t, size_t>> around_error(const PointGroup& group,
                                                      const std::vector<size_t>& stairs, double error) {
  for (size_t k = 0; k < stairs.size(); ++k) {
    const double right = group.points[stairs[k]].error.value;
    if (right == error) return std::pair(stairs[k], stairs[k]);
    if (right > error) continue;
    if (k == 0) return std::nullopt;
    return std::pair(stairs[k - 1], stairs[k]);
  }
  return std::nullopt;
}

std::optional<double> time_to_reach(const PointGroup& group, const std::vector<size_t>& stairs,
                                    double error) {
  const auto ends = around_error(group, stairs, error);
  if (!ends) return std::nullopt;
  const Point &left = group.points[ends->first], &right = group.points[ends->second];
  if (right.error.value == error) return right.ms.value;
  return between(left.error.value, left.ms.value, right.error.value, right.ms.value, error);
}

}  // namespace vsglbench
