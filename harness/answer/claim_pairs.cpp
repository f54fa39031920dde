// Which cases of a report a claim compares, and the ratio of each pair.
#include "answer/claim_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "answer/claim_values.h"

namespace vsglbench {
namespace {

// --- which cases are meant ---

// Numbers by value, so that 1 is 1.0, in single precision, which is what a report's settings went through;
// else as text.
bool equal(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) return a.get<float>() == b.get<float>();
  const auto text = [](const Json& v) { return v.is_string() ? v.get<std::string>() : v.dump(); };
  return text(a) == text(b);
}

bool allows(const Json& wanted, const Json& value) {
  if (!wanted.is_array()) return equal(wanted, value);
  return std::ranges::any_of(wanted, [&](const Json& w) { return equal(w, value); });
}

// A case that lacks a parameter is not asked for it: VPLs have no K.
bool matches(const CaseResult& c, const Json& settings) {
  for (const auto& item : settings.items()) {
    if (item.key() == "method") {
      if (!allows(item.value(), c.method)) return false;
      continue;
    }
    const auto at = c.parameters.find(item.key());
    if (at != c.parameters.end() && !allows(item.value(), *at)) return false;
  }
  return true;
}

// Where the two sides differ in a parameter, a case without it is on neither.
bool has_what_differs(const CaseResult& c, const PaperClaim& claim) {
  return std::ranges::all_of(claim.a.items(), [&](const auto& item) {
    return item.key() == "method" || !claim.b.contains(item.key()) || c.parameters.contains(item.key());
  });
}

// --- what a pair shows ---

ClaimCase trial_of(const CaseResult& c, const PaperClaim& claim, const std::string& metric) {
  ClaimCase t{&c, {}, {}, metric == "temporal.static"};
  if (is_time(metric) || claim.equal_time) {
    const auto ms = claimed_time(c, metric);
    if (ms && ms->median > 0) t.ms = Estimate{ms->median, ms->ci95};
  }
  if (!is_time(metric)) t.logs = logs_of(c, metric);
  return t;
}

std::optional<PairRatio> ratio_of_errors(const ClaimCase& a, const std::map<uint64_t, double>& b) {
  std::map<uint64_t, double> logs;
  for (const auto& [seed, log] : a.logs) {
    const auto other = b.find(seed);
    if (other != b.end()) logs[seed] = log - other->second;
  }
  const auto mean = mean_of_seeds(logs, a.of_pairs);
  if (!mean) return std::nullopt;
  return PairRatio{std::move(logs), *mean, a.of_pairs};
}

// Nothing beside nothing is no ratio.
bool tells_nothing(const ClaimCase& a, const ClaimCase& b, const std::string& metric) {
  return has_none(*a.result, metric) && has_none(*b.result, metric);
}

// What is noise in a time may be in either direction.
std::optional<PairRatio> ratio_of_times(const ClaimCase& a, const ClaimCase& b, double noise) {
  if (!a.ms || !b.ms || !(a.ms->ci95.lo > 0) || !(b.ms->ci95.lo > 0)) return std::nullopt;
  const double slack = std::log1p(noise);
  return PairRatio{
      {},
      {std::log(a.ms->value / b.ms->value),
       {std::log(a.ms->ci95.lo / b.ms->ci95.hi) - slack, std::log(a.ms->ci95.hi / b.ms->ci95.lo) + slack}},
      false};
}

// Logarithms of the error of a ladder, by time, at a time between its ends; nothing outside, but within
// `slack` of an end that end's.
std::optional<std::map<uint64_t, double>> at_time(const std::vector<const ClaimCase*>& ladder, double ms,
                                                  double slack) {
  if (ladder.empty() || ms < ladder.front()->ms->value / slack || ms > ladder.back()->ms->value * slack)
    return std::nullopt;
  if (ms <= ladder.front()->ms->value) return ladder.front()->logs;
  for (size_t k = 1; k < ladder.size(); ++k) {
    const ClaimCase &left = *ladder[k - 1], &right = *ladder[k];
    if (ms > right.ms->value) continue;
    const double t = std::log(ms / left.ms->value) / std::log(right.ms->value / left.ms->value);
    std::map<uint64_t, double> out;
    for (const auto& [seed, log] : left.logs) {
      const auto other = right.logs.find(seed);
      if (other != right.logs.end()) out[seed] = (1 - t) * log + t * other->second;
    }
    return out;
  }
  return ladder.back()->logs;
}

// The error of a beside that of the ladder at a's time. The interval holds what it would be at either end of
// what that time may be.
std::optional<PairRatio> ratio_at_time(const ClaimCase& a, const std::vector<const ClaimCase*>& ladder,
                                       double noise) {
  const double slack = 1 + std::max(noise, kSmallestEffect);
  const auto middle = at_time(ladder, a.ms->value, slack);
  if (!middle) return std::nullopt;
  auto out = ratio_of_errors(a, *middle);
  if (!out) return std::nullopt;
  for (const double ms : {a.ms->ci95.lo / slack, a.ms->ci95.hi * slack}) {
    const double inside = std::clamp(ms, ladder.front()->ms->value, ladder.back()->ms->value);
    const auto end = ratio_of_errors(a, *at_time(ladder, inside, slack));
    if (!end) continue;
    out->log.ci95.lo = std::min(out->log.ci95.lo, end->log.ci95.lo);
    out->log.ci95.hi = std::max(out->log.ci95.hi, end->log.ci95.hi);
  }
  return out;
}

// --- pairs ---

using Signature = std::string;

// Everything that both cases have and neither side names.
class Matching {
 public:
  Matching(const PaperClaim& claim, const std::vector<ClaimCase>& others) : claim_(claim), others_(others) {
    for (size_t i = 0; i < others.size(); ++i) by_keys_[keys_of(*others[i].result)].push_back(i);
  }

  // Trials that are like `c` in it.
  std::vector<const ClaimCase*> of(const CaseResult& c) {
    std::vector<const ClaimCase*> out;
    const std::set<std::string> own = keys_of(c);
    for (const auto& [keys, members] : by_keys_) {
      std::set<std::string> common;
      std::ranges::set_intersection(own, keys, std::inserter(common, common.end()));
      auto& index = indices_[{keys, common}];
      if (index.empty()) {
        for (const size_t i : members) index[signature(*others_[i].result, common)].push_back(i);
      }
      const auto at = index.find(signature(c, common));
      if (at == index.end()) continue;
      for (const size_t i : at->second) out.push_back(&others_[i]);
    }
    return out;
  }

 private:
  std::set<std::string> keys_of(const CaseResult& c) const {
    std::set<std::string> out;
    for (const auto& item : c.parameters.items()) {
      const std::string& key = item.key();
      if (!claim_.a.contains(key) && !claim_.b.contains(key) && key != claim_.step &&
          !(claim_.equal_time && key == "N"))
        out.insert(key);
    }
    return out;
  }
  Signature signature(const CaseResult& c, const std::set<std::string>& keys) const {
    Signature out = c.accuracy ? c.accuracy->reference.hash : "";
    if (!claim_.a.contains("method") && !claim_.b.contains("method")) out += '\n' + c.method;
    for (const auto& key : keys) out += '\n' + key + '=' + c.parameters.at(key).dump();
    return out;
  }

  const PaperClaim& claim_;
  const std::vector<ClaimCase>& others_;
  std::map<std::set<std::string>, std::vector<size_t>> by_keys_;
  std::map<std::pair<std::set<std::string>, std::set<std::string>>, std::map<Signature, std::vector<size_t>>>
      indices_;
};

// A ladder a choice of all that the claim does not fix, by time.
std::vector<std::vector<const ClaimCase*>> ladders(const std::vector<const ClaimCase*>& trials) {
  std::map<std::string, std::vector<const ClaimCase*>> by_rest;
  for (const ClaimCase* t : trials) {
    if (!t->ms) continue;
    std::string rest = t->result->method;
    for (const auto& item : t->result->parameters.items()) {
      if (item.key() != "N") rest += '\n' + item.key() + '=' + item.value().dump();
    }
    by_rest[rest].push_back(t);
  }
  std::vector<std::vector<const ClaimCase*>> out;
  for (auto& [rest, ladder] : by_rest) {
    std::ranges::sort(ladder, {}, [](const ClaimCase* t) { return t->ms->value; });
    out.push_back(std::move(ladder));
  }
  return out;
}

// Of cases that are alike in all but the parameter, those with its next smaller value.
std::vector<const ClaimCase*> step_below(const std::string& key, const CaseResult& c,
                                         const std::vector<const ClaimCase*>& others) {
  const auto value = [&](const CaseResult& of) { return of.parameters.at(key).get<double>(); };
  std::vector<const ClaimCase*> out;
  for (const ClaimCase* other : others) {
    const double below = value(*other->result);
    if (!(below < value(c)) || (!out.empty() && below < value(*out.front()->result))) continue;
    if (!out.empty() && below > value(*out.front()->result)) out.clear();
    out.push_back(other);
  }
  return out;
}

}  // namespace

std::optional<Estimate> mean_of_seeds(const std::map<uint64_t, double>& logs, bool of_pairs) {
  if (logs.size() < (of_pairs ? 3 : 2)) return std::nullopt;
  std::vector<double> samples;
  for (const auto& [seed, log] : logs) samples.push_back(log);
  const MeanEstimate mean = mean_ci95(samples);
  if (!of_pairs) return Estimate{mean.mean, mean.ci95};
  // Each pair's distance is in two of them. The jackknife's pseudovalues (image/static_flicker.h) scatter so
  // much more.
  const auto count = static_cast<double>(samples.size());
  const double wider = 2 * (count - 1) / (count - 2);
  const double half = 0.5 * mean.ci95.width() * wider;
  return Estimate{mean.mean, {mean.mean - half, mean.mean + half}};
}

Sides sides_of(const Report& report, const PaperClaim& claim, const std::string& scene,
               const std::string& metric) {
  Sides out;
  for (const CaseResult& c : report.cases) {
    if (c.scene != scene || c.status != Status::ok || !matches(c, claim.both) || !has_what_differs(c, claim))
      continue;
    if (!claim.step.empty() &&
        !(c.parameters.contains(claim.step) && c.parameters.at(claim.step).is_number()))
      continue;
    if (matches(c, claim.a)) out.a.push_back(trial_of(c, claim, metric));
    if (matches(c, claim.b)) out.b.push_back(trial_of(c, claim, metric));
  }
  return out;
}

std::vector<PairRatio> pairs_of(const PaperClaim& claim, const Sides& sides, const std::string& metric,
                                double noise) {
  std::vector<PairRatio> out;
  Matching matching(claim, sides.b);
  for (const ClaimCase& a : sides.a) {
    auto others = matching.of(*a.result);
    if (!claim.step.empty()) others = step_below(claim.step, *a.result, others);
    if (claim.equal_time) {
      if (!a.ms) continue;
      for (const auto& ladder : ladders(others)) {
        if (auto ratio = ratio_at_time(a, ladder, noise)) out.push_back(std::move(*ratio));
      }
      continue;
    }
    for (const ClaimCase* b : others) {
      auto ratio = is_time(metric) ? ratio_of_times(a, *b, noise) : ratio_of_errors(a, b->logs);
      if (ratio && !tells_nothing(a, *b, metric)) out.push_back(std::move(*ratio));
    }
  }
  return out;
}

}  // namespace vsglbench
