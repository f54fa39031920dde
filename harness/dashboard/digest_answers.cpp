// Budgets, prices, flicker and claims: what the programme concludes of a report.
#include <algorithm>
#include <cmath>
#include <map>

#include "answer/analysis.h"
#include "answer/budget.h"
#include "answer/claims.h"
#include "answer/front.h"
#include "answer/price.h"
#include "dashboard/columns.h"
#include "dashboard/digest.h"
#include "papers/page.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

constexpr size_t kMostBudgets = 24;  // of a front
constexpr size_t kMostPrices = 24;   // of a knob

using CaseIndex = std::map<std::string, int>;  // by id

CaseIndex index_of(const Report& report) {
  CaseIndex out;
  for (size_t i = 0; i < report.cases.size(); ++i) out[report.cases[i].id] = static_cast<int>(i);
  return out;
}

int at(const CaseIndex& index, const std::string& id) {
  const auto it = index.find(id);
  return it == index.end() ? -1 : it->second;
}

Json budget_json(const Budget& budget, const std::string& metric, const CaseIndex& index) {
  Json parts = Json::array();
  for (const BudgetPart& p : budget.parts) {
    Json error = nullptr;
    if (p.error) error = {rounded(p.error->value), rounded(p.error->ci95.lo), rounded(p.error->ci95.hi)};
    parts.push_back({{"name", p.name},
                     {"case", at(index, p.case_id)},
                     {"missing", p.missing},
                     {"error", std::move(error)},
                     {"increment", rounded(p.increment)}});
  }
  return {{"case", at(index, budget.case_id)},
          {"metric", metric},
          {"parts", std::move(parts)},
          {"flux_lost", rounded(budget.flux_lost)}};
}

Json price_json(const PointGroup& g, const Price& p, const CaseIndex& index) {
  return {{"from", p.from},
          {"to", p.to},
          {"before", at(index, g.points[p.before].result->id)},
          {"after", at(index, g.points[p.after].result->id)},
          {"error", rounded(p.error)},
          {"ms", rounded(p.ms)},
          {"pass", p.pass},
          {"pass_ms", rounded(p.pass_ms)}};
}

// What pairs of one method come to: sums, so that the page can add up those of the methods that it shows.
struct PairSums {
  size_t pairs = 0;
  double error = 0;                      // of ln(after / before)
  std::map<std::string, double> times;   // the same of each time that all pairs have
  std::map<std::string, size_t> passes;  // that pay, by the pairs in which they do
};

std::optional<double> log_time_ratio(const CaseResult& before, const CaseResult& after,
                                     const std::string& time) {
  const std::optional<Summary> a = time_of(before, time), b = time_of(after, time);
  if (!a || !b || !(a->median > 0) || !(b->median > 0)) return std::nullopt;
  return std::log(b->median / a->median);
}

void add_pair(const Point& before, const Point& after, const Price& p, PairSums* sums) {
  const bool first = sums->pairs++ == 0;
  sums->error += std::log(after.error.value / before.error.value);
  for (const std::string& time : time_columns()) {
    // By points, which know the time of a report of old as well.
    const std::optional<double> log = time == "method"
                                          ? std::optional(std::log(after.ms.value / before.ms.value))
                                          : log_time_ratio(*before.result, *after.result, time);
    if (!log)
      sums->times.erase(time);
    else if (first)
      sums->times[time] = *log;
    else if (const auto known = sums->times.find(time); known != sums->times.end())
      known->second += *log;
  }
  ++sums->passes[p.pass];
}

// By key and method.
std::map<std::string, std::map<std::string, PairSums>> pair_sums(const PointGroup& g,
                                                                 const std::vector<Price>& prices) {
  std::map<std::string, std::map<std::string, PairSums>> out;
  for (const Price& p : prices) {
    const Point &before = g.points[p.before], &after = g.points[p.after];
    if (before.error.value > 0 && after.error.value > 0)
      add_pair(before, after, p, &out[p.key][before.result->method]);
  }
  return out;
}

Json pair_sums_json(const std::string& method, const PairSums& s) {
  Json times = Json::object();
  for (const auto& [time, log] : s.times) times[time] = rounded(log);
  return {{"method", method},
          {"pairs", s.pairs},
          {"error", rounded(s.error)},
          {"times", std::move(times)},
          {"passes", s.passes}};
}

void add_knobs(const PointGroup& g, int group, const std::string& metric, const CaseIndex& index, Json* out) {
  const std::vector<Price> all = prices(g);
  std::map<std::string, Json> by_key;
  for (const Price& p : all) {
    Json& list = by_key.try_emplace(p.key, Json::array()).first->second;
    if (list.size() < kMostPrices) list.push_back(price_json(g, p, index));
  }
  for (const auto& [key, methods] : pair_sums(g, all)) {
    Json sums = Json::array();
    for (const auto& [method, s] : methods) sums.push_back(pair_sums_json(method, s));
    out->push_back({{"group", group},
                    {"metric", metric},
                    {"key", key},
                    {"methods", std::move(sums)},
                    {"prices", by_key[key]}});
  }
}

Json flicker_json(const FlickerSeries& f) {
  Json series = Json::array();
  for (const double v : f.series) series.push_back(rounded(v));
  const Interval ci = f.ci95.value_or(Interval{f.value, f.value});
  return {{"value", rounded(f.value)}, {"lo", rounded(ci.lo)},         {"hi", rounded(ci.hi)},
          {"p99", rounded(f.p99)},     {"worst_frame", f.worst_frame}, {"series", std::move(series)}};
}

Json detail_json(const DetailResult& d) {
  const Interval ci = d.ci95.value_or(Interval{d.value, d.value});
  return {
      {"value", rounded(d.value)}, {"lo", rounded(ci.lo)}, {"hi", rounded(ci.hi)}, {"gain", rounded(d.gain)}};
}

// "fis beside mfis, at equal N; the ratio must be below 1" and where it was tried.
Json claim_json(const TriedClaim& tried, const ClaimRow& row) {
  const bool known = row.pairs > 0;
  return {{"claim", tried.claim.name},
          {"text", tried.claim.text},
          {"source", tried.claim.source},
          {"how", comparison_text(tried.claim)},
          {"exhibit", ""},
          {"place", row.scene},
          {"metric", row.metric},
          {"ruling", std::string(name(row.ruling))},
          {"ratio", known ? rounded(row.ratio) : Json(nullptr)},
          {"lo", known ? rounded(row.ci95.lo) : Json(nullptr)},
          {"hi", known ? rounded(row.ci95.hi) : Json(nullptr)},
          {"pairs", row.pairs},
          {"why", row.why}};
}

}  // namespace

DigestAnswers digest_answers(const Report& report, const DigestGroups& groups) {
  DigestAnswers out;
  const CaseIndex index = index_of(report);
  for (const Json& m : digest_metrics(report)) {
    const auto metric = m.at("name").get<std::string>();
    if (std::ranges::count(analysed_metrics(), metric) == 0) continue;
    const AnswerOptions options{metric, "method"};
    for (const PointGroup& g : point_groups(report, options)) {
      const int group = groups.of_case[at(index, g.points.front().result->id)];
      const std::vector<size_t> front = front_of(g);
      for (size_t k = 0; k < std::min(front.size(), kMostBudgets); ++k) {
        const CaseResult& c = *g.points[front[k]].result;
        out.budgets.push_back(budget_json(error_budget(report, c, options), metric, index));
      }
      add_knobs(g, group, metric, index, &out.knobs);
    }
  }
  return out;
}

Json digest_temporal(const Report& report) {
  Json out = Json::array();
  for (size_t i = 0; i < report.cases.size(); ++i) {
    const CaseResult& c = report.cases[i];
    if (!c.temporal) continue;
    const Temporal& t = *c.temporal;
    out.push_back({{"case", i},
                   {"derivative", flicker_json(t.derivative)},
                   {"static", t.still ? flicker_json(*t.still) : Json(nullptr)},
                   {"detail", t.detail ? detail_json(*t.detail) : Json(nullptr)},
                   {"noise_floor", rounded(t.noise_floor)},
                   {"unlit", rounded(t.unlit)},
                   {"profile", -1},
                   {"worst", -1}});
  }
  return out;
}

Json digest_claims(const Report& report) {
  Json out = Json::array();
  for (const PaperClaim& claim : load_claims()) {
    const TriedClaim tried = try_claim(report, claim);
    for (const ClaimRow& row : tried.rows) {
      if (row.ruling != Ruling::not_run) out.push_back(claim_json(tried, row));
    }
  }
  return out;
}

Json digest_papers(const Json& papers, const std::string& file) {
  Json out = Json::array();
  if (!papers.is_object() || papers.value("schema", Json()) != kPapersSchema)
    throw fail(ErrorKind::config, "{}: no papers.json of `vsglbench reproduce`: its schema is not {}", file,
               kPapersSchema);
  try {
    for (const ClaimTrial& t : trials_in(papers)) {
      out.push_back({{"claim", t.claim},
                     {"text", t.text},
                     {"source", t.source},
                     {"how", t.how},
                     {"exhibit", t.exhibit},
                     {"place", t.place},
                     {"metric", t.metric},
                     {"ruling", std::string(name(t.ruling))},
                     {"ratio", rounded(t.ratio)},
                     {"lo", t.ci95 ? rounded(t.ci95->lo) : Json(nullptr)},
                     {"hi", t.ci95 ? rounded(t.ci95->hi) : Json(nullptr)},
                     {"pairs", 0},
                     {"why", t.figures}});
    }
  } catch (const std::exception& e) {
    throw fail(ErrorKind::config, "{}: no papers.json of `vsglbench reproduce`: {}", file, e.what());
  }
  return out;
}

}  // namespace vsglbench
