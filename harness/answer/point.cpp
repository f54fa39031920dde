#include "answer/point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/nearest.h"
#include "report/metric_cell.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

struct Named {
  const char *name, *title, *unit;
  Metric metric;
  MetricResult Accuracy::*result;
  std::optional<double> (*floor)(const ReferenceInfo& reference);
};

// Bias has a sign, and no place on an axis that is logarithmic.
const std::array<Named, 6> kAxes = {{
    {"smape", "SMAPE", " %", Metric::smape, &Accuracy::smape,
     [](const ReferenceInfo& r) { return std::optional(r.noise_floor_smape); }},
    {"smape_lit", "lit SMAPE", " %", Metric::smape_lit, &Accuracy::smape_lit,
     [](const ReferenceInfo& r) { return r.noise_floor_smape_lit; }},
    {"rmse", "RMSE", "", Metric::rmse, &Accuracy::rmse,
     [](const ReferenceInfo& r) { return r.noise_floor_rmse; }},
    {"rrmse", "relative RMSE", "", Metric::rrmse, &Accuracy::rrmse,
     [](const ReferenceInfo& r) { return r.noise_floor_rrmse; }},
    {"mrse", "MRSE", "", Metric::mrse, &Accuracy::mrse,
     [](const ReferenceInfo& r) { return r.noise_floor_mrse; }},
    {"flip", "FLIP", "", Metric::flip, &Accuracy::flip,
     [](const ReferenceInfo& r) { return r.noise_floor_flip; }},
}};

const Named& axis(const std::string& metric) {
  std::vector<std::string> names;
  for (const Named& n : kAxes) {
    if (n.name == metric) return n;
    names.push_back(n.name);
  }
  throw fail(ErrorKind::usage, "no error is named '{}'; did you mean '{}'? There are {}", metric,
             nearest_name(metric, names), fmt::join(names, ", "));
}

void check_time(const std::string& time) {
  const auto& names = time_columns();
  if (std::ranges::count(names, time) > 0) return;
  throw fail(ErrorKind::usage, "no time is named '{}'; did you mean '{}'? There are {}", time,
             nearest_name(time, names), fmt::join(names, ", "));
}

std::vector<double> seeds_of(const CaseResult& c, Metric metric) {
  std::vector<double> out;
  for (const SeedResult& s : c.seeds) {
    if (const auto v = s.errors.value(metric)) out.push_back(*v);
  }
  return out;
}

MetricResult judged_result(const CaseResult& c, const Named& metric) {
  return judged((*c.accuracy).*metric.result, metric.metric, c.seeds);
}

Estimate estimate_of(const MetricResult& m) {
  if (m.heavy_tailed) return {*m.median, {*m.least, *m.largest}};
  return {*m.value, m.ci95.value_or(Interval{*m.value, *m.value})};
}

// Time must be above 0 for a logarithm; an error of 0 is exact and stays.
std::optional<Point> point_of(const CaseResult& c, const Named& metric, const std::string& time) {
  if (c.status != Status::ok || !c.accuracy) return std::nullopt;
  if (!((*c.accuracy).*metric.result).value) return std::nullopt;
  std::optional<Summary> ms = time_of(c, time);
  if (!ms && time == "method") ms = method_time(c.passes);  // a report of old has the passes alone
  if (!ms || !(ms->median > 0)) return std::nullopt;
  const std::vector<double> seeds = seeds_of(c, metric.metric);
  const MetricResult error = judged_result(c, metric);
  return Point{&c, estimate_of(error), seeds, {ms->median, ms->ci95}, error.heavy_tailed, ms->samples.size()};
}

Relation relation(const Interval& ratio, double margin) {
  const double above = 1 + margin, below = 1 / above;
  if (ratio.hi < below) return Relation::better;
  if (ratio.lo > above) return Relation::worse;
  return ratio.lo >= below && ratio.hi <= above ? Relation::same : Relation::ambiguous;
}

// The widest that the ratio of two numbers in these intervals can be.
Interval ratio_of(const Interval& a, const Interval& b) {
  const double least = 1e-300;  // an error of 0, or an interval that reaches below it
  return {std::max(a.lo, 0.0) / std::max(b.hi, least), std::max(a.hi, least) / std::max(b.lo, least)};
}

bool same_seeds(const Point& a, const Point& b) {
  if (a.seeds.size() < 2 || a.seeds.size() != b.seeds.size()) return false;
  const auto positive = [](double v) { return v > 0; };
  if (!std::ranges::all_of(a.seeds, positive) || !std::ranges::all_of(b.seeds, positive)) return false;
  return std::ranges::equal(a.result->seeds, b.result->seeds, {}, &SeedResult::seed, &SeedResult::seed);
}

}  // namespace

const MetricResult* metric_of(const Accuracy& accuracy, const std::string& metric) {
  const MetricResult& m = accuracy.*axis(metric).result;
  return m.value ? &m : nullptr;
}

std::optional<Estimate> error_of(const CaseResult& c, const std::string& metric) {
  if (!c.accuracy || !metric_of(*c.accuracy, metric)) return std::nullopt;
  return estimate_of(judged_result(c, axis(metric)));
}

bool is_heavy_tailed(const CaseResult& c, const std::string& metric) {
  return c.accuracy && metric_of(*c.accuracy, metric) && judged_result(c, axis(metric)).heavy_tailed;
}

std::vector<double> seeds_of(const CaseResult& c, const std::string& metric) {
  return seeds_of(c, axis(metric).metric);
}

std::vector<std::string> error_names() {
  std::vector<std::string> names;
  for (const Named& n : kAxes) names.emplace_back(n.name);
  return names;
}

std::string metric_title(const std::string& metric) { return axis(metric).title; }
std::string metric_unit(const std::string& metric) { return axis(metric).unit; }

std::string time_words(const std::string& time) {
  static const std::map<std::string, std::string> words = {
      {"method", "all passes but the raster of the two halves"},
      {"frame", "the whole frame"},
      {"generate", "light generation in both halves"},
      {"generate.rsm", "light generation from the RSM"},
      {"generate.gbuffer", "light generation from the G-buffer"},
      {"fixed", "the raster of the two halves"},
      {"importance", "the importance passes"},
      {"visibility", "shadow maps"},
      {"shade", "shading"},
      {"rays", "the host's shadow rays"}};
  return words.at(time);
}

std::vector<PointGroup> point_groups(const Report& report, const AnswerOptions& options) {
  const Named& metric = axis(options.metric);
  check_time(options.time);
  std::vector<PointGroup> groups;
  std::map<std::pair<std::string, std::string>, size_t> known;  // by scene and reference
  for (const CaseResult& c : report.cases) {
    std::optional<Point> point = point_of(c, metric, options.time);
    if (!point) continue;
    const ReferenceInfo& reference = c.accuracy->reference;
    const auto [at, added] = known.try_emplace({c.scene, reference.hash}, groups.size());
    if (added) {
      PointGroup g{c.scene,
                   reference.hash,
                   c.parameters.value("visibility", "") == "none" ? "none" : "full",
                   {},
                   0,
                   false,
                   0};
      if (const TimeNoise* noise = noise_of(report, c.scene, options.time)) {
        g.noise = noise->noise_floor;
        g.noise_known = true;
      }
      g.error_floor = metric.floor(reference).value_or(0);
      groups.push_back(std::move(g));
    }
    groups[at->second].points.push_back(std::move(*point));
  }
  for (PointGroup& g : groups) {
    std::ranges::stable_sort(g.points, {}, [](const Point& p) { return p.ms.value; });
  }
  return groups;
}

Relation compare_errors(const Point& a, const Point& b, double margin) {
  if (!same_seeds(a, b)) return relation(ratio_of(a.error.ci95, b.error.ci95), margin);
  std::vector<double> logs;
  for (size_t i = 0; i < a.seeds.size(); ++i) logs.push_back(std::log(a.seeds[i] / b.seeds[i]));
  const Interval ci = mean_ci95(logs).ci95;
  return relation({std::exp(ci.lo), std::exp(ci.hi)}, margin);
}

Relation compare_costs(const Point& a, const Point& b, double margin) {
  return relation(ratio_of(a.ms.ci95, b.ms.ci95), std::max(margin, kSmallestEffect));
}

}  // namespace vsglbench
