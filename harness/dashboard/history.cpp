#include "dashboard/history.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "dashboard/columns.h"
#include "dashboard/digest.h"
#include "measure/creep.h"
#include "report/case_names.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

constexpr size_t kMostFigures = 1'500'000;  // values with both ends of their intervals
constexpr int kDigits = 5;

const std::vector<std::string>& history_times() {
  static const std::vector<std::string> names = {"method",     "frame",      "generate",
                                                 "importance", "visibility", "shade"};
  return names;
}
const std::vector<std::string>& history_metrics() {
  static const std::vector<std::string> names = {"smape", "rmse", "flip"};
  return names;
}

bool is_time(const std::string& column) { return std::ranges::count(history_times(), column) > 0; }

std::string title_of(const std::string& column) {
  if (!is_time(column)) return metric_title(column);
  return column == "method" ? "method time" : column;
}

}  // namespace

void History::add_case(const CaseResult& c, const Report& report) {
  const auto [at, added] = series_.try_emplace(c.id);
  Series& s = at->second;
  if (added) {
    ids_.push_back(c.id);
    s.scene = c.scene;
    s.method = c.method;
  }
  const size_t now = reports_.size();
  for (const std::string& time : history_times()) {
    if (const std::optional<Summary> ms = time_of(c, time)) s.columns[time].of[now] = {ms->median, ms->ci95};
    if (const TimeNoise* n = noise_of(report, c.scene, time))
      s.noise[time] = std::max(s.noise[time], n->noise_floor);
  }
  for (const std::string& metric : history_metrics()) {
    if (const auto error = error_of(c, metric)) s.columns[metric].of[now] = *error;
  }
}

void History::add_changes(const Comparison& comparison) {
  const auto add = [&](const std::string& id, const std::string& column, Change change, const Ratio& ratio) {
    if (change == Change::same || change == Change::ambiguous || !series_.contains(id)) return;
    steps_.push_back({reports_.size(), id, column, change, ratio});
  };
  // With the same kernels and driver, differences of time are noise.
  for (const TimeChange& t : comparison.byte_equal ? std::vector<TimeChange>() : comparison.times)
    add(t.case_id, "method", t.change, t.ratio);
  for (const ErrorChange& e : comparison.errors) {
    if (std::ranges::count(history_metrics(), e.metric) > 0) add(e.case_id, e.metric, e.change, e.ratio);
  }
}

void History::add(const Report& report, const std::string& file) {
  std::vector<const CaseResult*> cases;
  for (const CaseResult& c : report.cases) {
    if (c.status != Status::ok) continue;
    add_case(c, report);
    cases.push_back(&c);
  }
  const CaseNames names(cases);
  for (const CaseResult* c : cases) series_.at(c->id).label = names.label(*c);
  std::string refusal;
  bool other_kernels = true;
  if (last_) {
    const Comparison comparison = compare_reports(*last_, report, {.cases_alone = true});
    refusal = comparison.refusal;
    other_kernels = !comparison.byte_equal;
    add_changes(comparison);
  }
  other_kernels_.push_back(other_kernels);
  reports_.push_back({{"file", file},
                      {"name", config_name(report)},
                      {"created", report.created},
                      {"commit", report.git.commit == "unknown" ? "" : report.git.commit},
                      {"dirty", report.git.dirty},
                      {"device", report.device.name},
                      {"refusal", refusal}});
  last_ = report;
}

double History::noise_of_series(const Series& s, const std::string& column) const {
  const auto noise = s.noise.find(column);
  return std::max(kSmallestEffect, noise == s.noise.end() ? 0 : noise->second);
}

// Whether every report since, and at least one, is as far from what was before as noise does not reach.
bool History::persists(const Step& step) const {
  const Series& s = series_.at(step.case_id);
  const auto& figures = s.columns.at(step.column).of;
  const auto before = figures.lower_bound(step.report);
  if (before == figures.begin()) return false;
  const double base = std::prev(before)->second.value;
  const double margin = 1 + noise_of_series(s, step.column);
  size_t later = 0;
  for (auto it = figures.upper_bound(step.report); it != figures.end(); ++it, ++later) {
    const double ratio = base > 0 ? it->second.value / base : 1;
    if (step.ratio.value > 1 ? ratio < margin : ratio > 1 / margin) return false;
  }
  return later > 0;
}

// Where figures drift too slowly for two reports beside each other to show it: stretch by stretch, from one
// step that lasted, or refusal, to the next.
void History::add_creeping(const std::string& id, const std::string& column, std::vector<Step>* out) const {
  const Series& s = series_.at(id);
  const auto known = s.columns.find(column);
  if (known == s.columns.end()) return;
  std::set<size_t> starts = {reports_.size()};
  for (size_t r = 0; r < reports_.size(); ++r) {
    if (reports_[r].at("refusal") != "") starts.insert(r);
  }
  for (const Step& step : steps_) {
    if (step.case_id == id && step.column == column && persists(step)) starts.insert(step.report);
  }
  auto figure = known->second.of.begin();
  for (const size_t end : starts) {
    std::vector<size_t> reports;
    std::vector<double> values;
    bool same_kernels = true;  // in all but the first: what differs in time is the machine then
    for (; figure != known->second.of.end() && figure->first < end; ++figure) {
      if (!reports.empty() && other_kernels_[figure->first]) same_kernels = false;
      reports.push_back(figure->first);
      values.push_back(figure->second.value);
    }
    const auto creep = creep_of(values, noise_of_series(s, column));
    if (!creep || (same_kernels && is_time(column))) continue;
    const bool more = creep->ratio.value > 1;
    const Change change =
        is_time(column) ? (more ? Change::slower : Change::faster) : (more ? Change::worse : Change::better);
    out->push_back({reports[creep->from], id, column, change, creep->ratio, reports[creep->to]});
  }
}

std::vector<History::Step> History::creeping(const std::vector<std::string>& columns) const {
  std::vector<Step> out;
  for (const std::string& id : ids_) {
    for (const std::string& column : columns) {
      // Those that steps are looked for in.
      if (column == "method" || !is_time(column)) add_creeping(id, column, &out);
    }
  }
  return out;
}

Json History::json(std::vector<std::string>* notes) const {
  std::vector<std::string> columns;
  size_t figures = 0;
  for (const auto* list : {&history_times(), &history_metrics()}) {
    for (const std::string& column : *list) {
      size_t count = 0;
      for (const auto& [id, s] : series_) count += s.columns.contains(column) ? reports_.size() : 0;
      if (count > 0) columns.push_back(column);
      figures += 3 * count;
    }
  }
  if (figures > kMostFigures) {
    std::erase_if(columns, [](const std::string& c) { return c != "method" && c != "smape"; });
    notes->push_back(
        fmt::format("the history has {} series of {} reports: it shows the method's time and SMAPE alone",
                    ids_.size(), reports_.size()));
  }
  Json out = {{"reports", reports_},
              {"columns", Json::array()},
              {"series", Json::array()},
              {"changes", Json::array()}};
  for (const std::string& c : columns) {
    out["columns"].push_back({{"name", c},
                              {"title", title_of(c)},
                              {"unit", is_time(c) ? " ms" : metric_unit(c)},
                              {"time", is_time(c)}});
  }
  std::map<std::string, size_t> place;
  for (const std::string& id : ids_) {
    const Series& s = series_.at(id);
    Json values = Json::object(), noise = Json::object();
    for (const std::string& c : columns) {
      const auto at = s.columns.find(c);
      if (at == s.columns.end()) continue;
      EstimateColumn column;
      for (size_t r = 0; r < reports_.size(); ++r) {
        const auto figure = at->second.of.find(r);
        column.add(figure == at->second.of.end() ? std::nullopt : std::optional(figure->second), kDigits);
      }
      values[c] = to_json(column);
    }
    for (const auto& [time, floor] : s.noise) noise[time] = rounded(floor, kDigits);
    place[id] = place.size();
    out["series"].push_back({{"id", id},
                             {"scene", s.scene},
                             {"method", s.method},
                             {"label", s.label},
                             {"values", std::move(values)},
                             {"noise", std::move(noise)}});
  }
  std::vector<Step> changes = steps_;
  std::ranges::copy(creeping(columns), std::back_inserter(changes));
  for (const Step& step : changes) {
    if (std::ranges::count(columns, step.column) == 0) continue;
    out["changes"].push_back({{"report", step.report},
                              {"series", place.at(step.case_id)},
                              {"column", step.column},
                              {"change", std::string(name(step.change))},
                              {"ratio", rounded(step.ratio.value, kDigits)},
                              {"lo", rounded(step.ratio.ci95.lo, kDigits)},
                              {"hi", rounded(step.ratio.ci95.hi, kDigits)},
                              {"until", step.until ? Json(*step.until) : Json(nullptr)},
                              {"persistent", step.until || persists(step)}});
  }
  return out;
}

}  // namespace vsglbench
