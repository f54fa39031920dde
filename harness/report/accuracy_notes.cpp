#include "report/accuracy_notes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "report/metric_cell.h"

namespace vsglbench {
namespace {

constexpr double kBlackShare = 0.99;
constexpr size_t kMostPairs = 3;

double middle(const MetricResult& m) { return m.heavy_tailed ? *m.median : *m.value; }

std::string told(const MetricResult& m) { return significant(middle(m), 3); }

Interval range(const MetricResult& m) {
  if (m.heavy_tailed) return {*m.least, *m.largest};
  return m.ci95 ? *m.ci95 : Interval{*m.value, *m.value};
}

// −1 when `a` is better, 1 when `b` is, 0 when that cannot be told.
int ranks(const MetricResult& a, const MetricResult& b, double floor) {
  const Interval p = range(a), q = range(b);
  if (std::abs(middle(a) - middle(b)) <= floor) return 0;
  return p.hi < q.lo ? -1 : q.hi < p.lo ? 1 : 0;
}

// "mfis", or "mfis/N=64,…" where the scene has several cases of it.
std::string short_name(const CaseResult& c, const std::vector<const CaseResult*>& cases) {
  const auto same = std::count_if(cases.begin(), cases.end(),
                                  [&](const CaseResult* other) { return other->method == c.method; });
  return same == 1 ? c.method : c.id.substr(std::min(c.id.size(), c.scene.size() + 1));
}

void note_ranks(const std::vector<const CaseResult*>& cases, std::vector<std::string>* notes) {
  std::vector<std::string> pairs;  // the first ones
  size_t count = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    for (size_t k = i + 1; k < cases.size(); ++k) {
      const Accuracy *a = &*cases[i]->accuracy, *b = &*cases[k]->accuracy;
      if (a->reference.hash != b->reference.hash) continue;
      const int smape = ranks(a->smape, b->smape, a->reference.noise_floor_smape);
      const int rmse = ranks(a->rmse, b->rmse, a->reference.noise_floor_rmse.value_or(0));
      if (smape * rmse >= 0 || ++count > kMostPairs) continue;
      const CaseResult &x = smape < 0 ? *cases[i] : *cases[k], &y = smape < 0 ? *cases[k] : *cases[i];
      pairs.push_back(fmt::format("{} before {} (SMAPE {} and {} %, RMSE {} and {})", short_name(x, cases),
                                  short_name(y, cases), told(x.accuracy->smape), told(y.accuracy->smape),
                                  told(x.accuracy->rmse), told(y.accuracy->rmse)));
    }
  }
  if (pairs.empty()) return;
  std::string text = "SMAPE ranks " + pairs[0];
  for (size_t i = 1; i < pairs.size(); ++i) text += ", " + pairs[i];
  if (count > kMostPairs) text += fmt::format(" and {} more pairs", count - kMostPairs);
  notes->push_back(text + "; RMSE ranks them the other way round");
}

void note_darkness(const std::vector<const CaseResult*>& cases, std::vector<std::string>* notes) {
  std::set<std::string> seen;
  for (const CaseResult* c : cases) {
    const ReferenceInfo& r = c->accuracy->reference;
    if (!seen.insert(r.hash).second) continue;
    if (r.light_ratio && *r.light_ratio < kNearlyBlack) {
      notes->push_back(fmt::format(
          "the reference is nearly black: its mean is {:.2g} of what the light's flux could give; "
          "metrics relative to it are undefined. Does the light reach what the camera sees?",
          *r.light_ratio));
    } else if (r.black_share && *r.black_share > kBlackShare) {
      notes->push_back(
          fmt::format("the reference is black in {:.2f} % of its pixels; all metrics but SMAPE rest "
                      "on the others",
                      100 * *r.black_share));
    }
  }
}

}  // namespace

std::vector<std::string> accuracy_notes(const std::vector<CaseResult>& cases, const std::string& scene) {
  std::vector<const CaseResult*> measured;
  for (const CaseResult& c : cases) {
    if (c.scene == scene && c.status == Status::ok && c.accuracy) measured.push_back(&c);
  }
  std::vector<std::string> notes;
  note_darkness(measured, &notes);
  note_ranks(measured, &notes);
  return notes;
}

}  // namespace vsglbench
