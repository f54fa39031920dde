// Times of one case are two independent samples, those of a pass over many cases pairs of medians.
#include "answer/compare_times.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "report/noise.h"

namespace vsglbench {
namespace {

constexpr double kLeastSuperiority = 0.8;
constexpr int kResamples = 2000;
constexpr size_t kFewPairs = 3;  // of fewer nothing can be said of how they scatter

// --- samples ---

// Mann and Whitney's U as a probability; ties count half.
double superiority_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> sorted = b;
  std::ranges::sort(sorted);
  double wins = 0;
  for (const double v : a) {
    const auto [lower, upper] = std::equal_range(sorted.begin(), sorted.end(), v);
    wins += static_cast<double>(lower - sorted.begin()) + 0.5 * static_cast<double>(upper - lower);
  }
  return wins / (static_cast<double>(a.size()) * static_cast<double>(b.size()));
}

// exp of the mean of `logs` with the percentile bootstrap's interval.
Ratio geometric_mean(const std::vector<double>& logs) {
  std::mt19937_64 random(1);
  const size_t n = logs.size();
  double sum = 0;
  for (const double v : logs) sum += v;
  std::vector<double> means(kResamples);
  for (double& mean : means) {
    double s = 0;
    for (size_t i = 0; i < n; ++i) s += logs[random() % n];
    mean = s / static_cast<double>(n);
  }
  std::ranges::sort(means);
  return {std::exp(sum / static_cast<double>(n)),
          {std::exp(quantile_sorted(means, 0.025)), std::exp(quantile_sorted(means, 0.975))}};
}

Ratio exp_of(double log, const Interval& ci95) {
  return {std::exp(log), {std::exp(ci95.lo), std::exp(ci95.hi)}};
}

Change time_change(const TimeChange& t) {
  const double above = 1 + std::max(t.noise.value_or(0), kSmallestEffect), below = 1 / above;
  const Interval& ci = t.ratio.ci95;
  if (ci.lo > above && t.superiority >= kLeastSuperiority) return Change::slower;
  if (ci.hi < below && t.superiority >= kLeastSuperiority) return Change::faster;
  return ci.lo >= below && ci.hi <= above ? Change::same : Change::ambiguous;
}

// --- noise ---

// Nothing where neither report has an A/A pair with this time.
std::optional<double> larger_noise(const Report& base, const Report& now, const std::string& scene,
                                   const std::string& time) {
  std::optional<double> noise;
  for (const Report* report : {&base, &now}) {
    if (const TimeNoise* n = noise_of(*report, scene, time))
      noise = std::max(noise.value_or(0), n->noise_floor);
  }
  return noise;
}

// The times of an A/A pair that a pass is part of, the narrowest first; reports of old lack that.
std::vector<std::string> columns_of(const PassId& pass) {
  switch (pass.stage) {
    case PassStage::draw:
      return {"fixed", "frame"};
    case PassStage::generate:
      return {"generate"};
    case PassStage::importance:
      return {"importance", "method"};
    case PassStage::visibility:
      return {"visibility", "method"};
    case PassStage::shade:
      return {"shade", "method"};
    default:
      return {"method"};
  }
}

std::optional<double> noise_of_pass(const Report& base, const Report& now, const std::string& scene,
                                    const PassId& pass) {
  const auto is_known = [&](const std::string& time) {
    return noise_of(base, scene, time) && noise_of(now, scene, time);
  };
  const std::vector<std::string> columns = columns_of(pass);
  const auto known = std::ranges::find_if(columns, is_known);
  return larger_noise(base, now, scene, known == columns.end() ? columns.back() : *known);
}

// --- pairs of passes ---

// A pass of a case in both reports.
struct PassPair {
  const CasePair* of;
  const Summary *base, *now;
  std::optional<double> noise;
  double log = 0;  // of the ratio of medians, over the unit
};

template <class F>
void each_pass(const CasePair& pair, F visit) {
  for (const PassTiming& pass : pair.base->passes) {
    const auto at = std::ranges::find(pair.now->passes, pass.pass, &PassTiming::pass);
    if (at != pair.now->passes.end() && pass.ms.median > 0 && at->ms.median > 0) visit(pass, *at);
  }
}

std::map<PassStage, double> stages_of(const CaseResult& c) {
  std::map<PassStage, double> out;
  for (const PassTiming& p : c.passes) out[p.pass.stage] += p.ms.median;
  return out;
}

// The median, and once more that of those near it: what changed, and is a part of all, pulls the first.
double undisturbed_median(const std::vector<double>& values) {
  constexpr double kNear = 3;  // median deviations
  const double first = median(values);
  std::vector<double> deviations, near;
  for (const double v : values) deviations.push_back(std::abs(v - first));
  const double most = kNear * median(deviations);
  std::ranges::copy_if(values, std::back_inserter(near),
                       [&](double v) { return std::abs(v - first) <= most; });
  return median(near);
}

// How much longer everything takes in a scene, as a logarithm: the median over all stages of all its cases.
// Neither a stage that became slower in every case moves it, nor a method that did in every stage.
std::map<std::string, double> units_of(const std::vector<CasePair>& pairs) {
  std::map<std::string, std::vector<double>> logs;
  for (const CasePair& p : pairs) {
    const auto before = stages_of(*p.base), after = stages_of(*p.now);
    for (const auto& [stage, ms] : before) {
      const auto at = after.find(stage);
      if (at != after.end() && ms > 0 && at->second > 0)
        logs[p.base->scene].push_back(std::log(at->second / ms));
    }
  }
  std::map<std::string, double> out;
  for (const auto& [scene, values] : logs) out[scene] = undisturbed_median(values);
  return out;
}

double unit_in(const std::map<std::string, double>& units, const std::string& scene) {
  const auto at = units.find(scene);
  return at == units.end() ? 0 : at->second;
}

std::vector<double> logs_of(const std::vector<PassPair>& pairs) {
  std::vector<double> out;
  for (const PassPair& p : pairs) out.push_back(p.log);
  return out;
}

std::optional<double> middle_noise(const std::vector<PassPair>& pairs) {
  std::vector<double> known;
  for (const PassPair& p : pairs) {
    if (p.noise) known.push_back(*p.noise);
  }
  return known.empty() ? std::nullopt : std::optional(median(known));
}

double share_slower(const std::vector<PassPair>& pairs) {
  const auto slower = std::ranges::count_if(pairs, [](const PassPair& p) { return p.log > 0; });
  const double share = static_cast<double>(slower) / static_cast<double>(pairs.size());
  return std::max(share, 1 - share);
}

bool all_positive(const Summary& ms) {
  return std::ranges::all_of(ms.samples, [](double v) { return v > 0; });
}

// Of one or two cases: their frames' scatter in place of that of the cases. Nothing where a frame took no
// time.
std::optional<TimeChange> change_of_few(const std::vector<PassPair>& pairs) {
  const auto n = static_cast<double>(pairs.size());
  double log = 0, wins = 0;
  Interval ci;
  for (const PassPair& p : pairs) {
    if (!all_positive(*p.base) || !all_positive(*p.now)) return std::nullopt;
    const Ratio ratio = median_ratio(p.now->samples, p.base->samples);
    const double unit = std::log(p.now->median / p.base->median) - p.log;
    std::vector<double> now = p.now->samples;
    for (double& v : now) v /= std::exp(unit);
    log += p.log / n;
    ci.lo += (std::log(ratio.ci95.lo) - unit) / n;
    ci.hi += (std::log(ratio.ci95.hi) - unit) / n;
    wins += superiority_of(now, p.base->samples) / n;
  }
  return TimeChange{"", "", "", "", exp_of(log, ci), {}, std::max(wins, 1 - wins), Change::same};
}

std::optional<TimeChange> change_of_method(const std::vector<PassPair>& pairs) {
  if (pairs.size() < kFewPairs) return change_of_few(pairs);
  const MeanEstimate mean = mean_ci95(logs_of(pairs));
  return TimeChange{"", "", "", "", exp_of(mean.mean, mean.ci95), {}, share_slower(pairs), Change::same};
}

void compare_passes(const Report& base, const Report& now, const std::vector<CasePair>& pairs,
                    const std::map<std::string, double>& units, Comparison* out) {
  std::map<std::string, std::vector<PassPair>> by_pass;
  std::map<std::pair<std::string, std::string>, std::vector<PassPair>> by_method;  // and pass
  for (const CasePair& p : pairs) {
    const double unit = unit_in(units, p.base->scene);
    each_pass(p, [&](const PassTiming& b, const PassTiming& n) {
      const PassPair pair{&p, &b.ms, &n.ms, noise_of_pass(base, now, p.base->scene, b.pass),
                          std::log(n.ms.median / b.ms.median) - unit};
      by_pass[b.pass.name()].push_back(pair);
      by_method[{b.pass.name(), p.base->method}].push_back(pair);
    });
  }
  for (const auto& [key, list] : by_method) {
    auto t = change_of_method(list);
    if (!t) continue;
    t->time = key.first;
    t->method = key.second;
    t->noise = middle_noise(list);
    t->change = time_change(*t);
    out->method_passes.push_back(std::move(*t));
  }
  for (const auto& [pass, list] : by_pass) {
    if (list.size() < kFewPairs) continue;  // nothing to resample
    TimeChange t{
        "",          "", "", pass, geometric_mean(logs_of(list)), middle_noise(list), share_slower(list),
        Change::same};
    t.change = time_change(t);
    out->passes.push_back(std::move(t));
  }
}

// A change that one method has and another surely not is that method's, and not the pass's over all cases.
void leave_to_methods(Comparison* out) {
  for (TimeChange& t : out->passes) {
    if (t.change != Change::slower && t.change != Change::faster) continue;
    const auto has = [&](const TimeChange& m) { return m.time == t.time && m.change == t.change; };
    const auto has_not = [&](const TimeChange& m) {
      return m.time == t.time && m.change != t.change && m.change != Change::ambiguous;
    };
    if (std::ranges::any_of(out->method_passes, has) && std::ranges::any_of(out->method_passes, has_not))
      t.change = Change::ambiguous;
  }
}

void compare_methods(const Report& base, const Report& now, const std::vector<CasePair>& pairs,
                     const std::map<std::string, double>& units, Comparison* out) {
  for (const CasePair& p : pairs) {
    const auto b = time_of(*p.base, "method"), n = time_of(*p.now, "method");
    if (!b || !n || !(b->min > 0) || !(n->min > 0)) continue;
    std::vector<double> samples = n->samples;
    for (double& v : samples) v /= std::exp(unit_in(units, p.base->scene));
    TimeChange t{p.base->scene, p.base->id,  "", "method", median_ratio(samples, b->samples), {},
                 0.5,           Change::same};
    t.noise = larger_noise(base, now, t.scene, "method");
    const double wins = superiority_of(samples, b->samples);
    t.superiority = std::max(wins, 1 - wins);
    t.change = time_change(t);
    out->times.push_back(std::move(t));
  }
}

}  // namespace

void compare_times_of(const Report& base, const Report& now, const std::vector<CasePair>& pairs,
                      const CompareOptions& options, Comparison* out) {
  const auto units = options.ratios ? units_of(pairs) : std::map<std::string, double>();
  if (!options.cases_alone) {
    compare_passes(base, now, pairs, units, out);
    leave_to_methods(out);
  }
  compare_methods(base, now, pairs, units, out);
}

}  // namespace vsglbench
