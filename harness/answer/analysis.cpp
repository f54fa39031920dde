#include "answer/analysis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "answer/budget.h"
#include "answer/front.h"
#include "answer/price.h"

namespace vsglbench {
namespace {

constexpr size_t kMostDominators = 3;  // told of each dominated point
constexpr size_t kMostPairs = 24;      // told of each knob
constexpr size_t kMostBudgets = 24;    // of each front
constexpr size_t kSteps = 5;  // equal times and errors, evenly spaced in the logarithm over the front

Json interval(const Interval& i) { return {i.lo, i.hi}; }

const std::string& id(const PointGroup& g, size_t i) { return g.points[i].result->id; }

Json point_json(const PointGroup& g, size_t i) {
  const Point& p = g.points[i];
  return {{"case", p.result->id},
          {"ms", p.ms.value},
          {"ms_ci95", interval(p.ms.ci95)},
          {"error", p.error.value},
          {"error_ci95", interval(p.error.ci95)}};
}

// Every point that is not of the front, and where in its list those stand that dominate it, or could.
Json others_json(const PointGroup& g, const std::vector<size_t>& front) {
  std::map<size_t, size_t> places;
  for (size_t k = 0; k < front.size(); ++k) places[front[k]] = k;
  Json out = Json::array();
  for (const Placed& placed : place(g)) {
    if (placed.standing == Standing::front) continue;
    Json by = Json::array();
    for (const size_t f : placed.by) {
      if (by.size() < kMostDominators) by.push_back(places.at(f));
    }
    out.push_back(
        {{"case", id(g, placed.point)}, {"standing", std::string(name(placed.standing))}, {"by", by}});
  }
  return out;
}

// Methods by name, each with the staircase of its points.
std::map<std::string, std::vector<size_t>> staircases(const PointGroup& g) {
  std::map<std::string, std::vector<size_t>> points;
  for (size_t i = 0; i < g.points.size(); ++i) points[g.points[i].result->method].push_back(i);
  for (auto& [method, list] : points) list = staircase(g, list);
  return points;
}

// `kSteps` values from the first to the last, evenly spaced in the logarithm; fewer where they are one.
std::vector<double> steps(double from, double to) {
  if (!(from > 0) || !(to > 0)) return {};
  if (from == to) return {from};
  std::vector<double> out;
  for (size_t k = 0; k < kSteps; ++k) {
    const double t = static_cast<double>(k) / (kSteps - 1);
    out.push_back(k + 1 == kSteps ? to : from * std::pow(to / from, t));
  }
  return out;
}

// At each step the value of every method whose points stand on both sides of it.
template <class At>
Json equal_json(const PointGroup& g, const std::vector<double>& at, const char* axis, const char* value,
                At read) {
  Json out = Json::array();
  const auto stairs = staircases(g);
  for (const double step : at) {
    Json by_method = Json::object();
    for (const auto& [method, points] : stairs) {
      if (const std::optional<double> v = read(g, points, step)) by_method[method] = *v;
    }
    out.push_back({{axis, step}, {value, by_method}});
  }
  return out;
}

Json pair_json(const PointGroup& g, const Price& p) {
  Json pair = {{"from", p.from},          {"to", p.to},          {"before", id(g, p.before)},
               {"after", id(g, p.after)}, {"error", p.error},    {"ms", p.ms},
               {"pass", p.pass},          {"pass_ms", p.pass_ms}};
  if (const auto price = p.error_per_ms()) pair["error_per_ms"] = *price;
  return pair;
}

// Of many pairs those that touch the front come first.
Json knobs_json(const PointGroup& g, const std::vector<size_t>& front) {
  const std::vector<Price> all = prices(g);
  const std::set<size_t> ahead(front.begin(), front.end());
  std::map<std::string, std::vector<const Price*>> by_key;
  for (const bool touches : {true, false}) {
    for (const Price& p : all) {
      if ((ahead.contains(p.before) || ahead.contains(p.after)) == touches) by_key[p.key].push_back(&p);
    }
  }
  Json out = Json::array();
  for (const KnobSummary& k : knob_summaries(g, all)) {
    Json pairs = Json::array();
    for (const Price* p : by_key[k.key]) {
      if (pairs.size() < kMostPairs) pairs.push_back(pair_json(g, *p));
    }
    out.push_back({{"key", k.key},
                   {"pairs_in_all", k.pairs},
                   {"error_ratio", k.error_ratio},
                   {"time_ratio", k.cost_ratio},
                   {"pass", k.pass},
                   {"pairs", pairs}});
  }
  return out;
}

Json budget_json(const Budget& budget) {
  Json parts = Json::array();
  for (const BudgetPart& part : budget.parts) {
    Json entry = {{"name", part.name}};
    if (part.error) {
      entry["case"] = part.case_id;
      entry["error"] = part.error->value;
      if (part.increment) entry["increment"] = *part.increment;
    } else {
      entry["missing"] = part.missing;
    }
    parts.push_back(std::move(entry));
  }
  Json out = {{"case", budget.case_id}, {"parts", parts}};
  if (budget.flux_lost) out["flux_lost"] = *budget.flux_lost;
  return out;
}

Json group_json(const Report& report, const PointGroup& g, const AnswerOptions& options) {
  const std::vector<size_t> front = front_of(g);
  const Point &first = g.points[front.front()], &last = g.points[front.back()];
  Json front_points = Json::array(), budgets = Json::array();
  for (const size_t i : front) {
    front_points.push_back(point_json(g, i));
    if (budgets.size() < kMostBudgets)
      budgets.push_back(budget_json(error_budget(report, *g.points[i].result, options)));
  }
  Json out = {{"scene", g.scene},
              {"visibility", g.visibility},
              {"reference", g.reference},
              {"metric", options.metric},
              {"error_floor", g.error_floor},
              {"points", g.points.size()},
              {"front", front_points},
              {"others", others_json(g, front)},
              {"equal_time", equal_json(g, steps(first.ms.value, last.ms.value), "ms", "errors", error_at)},
              {"equal_error",
               equal_json(g, steps(first.error.value, last.error.value), "error", "ms", time_to_reach)},
              {"knobs", knobs_json(g, front)},
              {"budgets", budgets}};
  if (g.noise_known) out["time_noise"] = g.noise;
  return out;
}

}  // namespace

const std::vector<std::string>& analysed_metrics() {
  static const std::vector<std::string> metrics = {"smape", "rmse", "flip"};
  return metrics;
}

Json analysis_of(const Report& report, const std::string& time) {
  Json groups = Json::array();
  for (const std::string& metric : analysed_metrics()) {
    const AnswerOptions options{metric, time};
    for (const PointGroup& g : point_groups(report, options))
      groups.push_back(group_json(report, g, options));
  }
  if (groups.empty()) return nullptr;
  return {{"time", time}, {"groups", groups}};
}

}  // namespace vsglbench
