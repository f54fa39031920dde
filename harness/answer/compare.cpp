// Cases are paired by id, seeds by number; times of one case are two independent samples, those of one pass
// over all cases are pairs of medians.
#include "answer/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "base/error.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

constexpr double kLeastSuperiority = 0.8;
constexpr int kResamples = 2000;

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

Change time_change(const Ratio& r, double noise, double superiority) {
  const double above = 1 + std::max(noise, kSmallestEffect), below = 1 / above;
  if (r.ci95.lo > above && superiority >= kLeastSuperiority) return Change::slower;
  if (r.ci95.hi < below && superiority >= kLeastSuperiority) return Change::faster;
  return r.ci95.lo >= below && r.ci95.hi <= above ? Change::same : Change::ambiguous;
}

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

struct Pair {
  const CaseResult *base, *now;
};

std::map<std::string, const CaseResult*> by_id(const Report& report) {
  std::map<std::string, const CaseResult*> out;
  for (const CaseResult& c : report.cases) out[c.id] = &c;
  return out;
}

std::vector<Pair> pair_up(const Report& base, const Report& now, Comparison* out) {
  const auto before = by_id(base), after = by_id(now);
  std::vector<Pair> pairs;
  for (const CaseResult& b : base.cases) {
    const auto at = after.find(b.id);
    if (at == after.end()) {
      out->missing.push_back(b.id);
      continue;
    }
    const CaseResult& n = *at->second;
    if (b.status == Status::ok && n.status == Status::ok) pairs.push_back({&b, &n});
    if (b.status == Status::ok && n.status == Status::failed) out->broken.push_back(b.id);
    if (b.status == Status::failed && n.status == Status::ok) out->mended.push_back(b.id);
  }
  for (const CaseResult& n : now.cases) {
    if (!before.contains(n.id)) out->added.push_back(n.id);
  }
  out->cases = pairs.size();
  return pairs;
}

struct MetricField {
  const char* name;
  Metric metric;
  MetricResult Accuracy::*result;
};
constexpr std::array<MetricField, 7> kFields = {{{"smape", Metric::smape, &Accuracy::smape},
                                                 {"smape_lit", Metric::smape_lit, &Accuracy::smape_lit},
                                                 {"rmse", Metric::rmse, &Accuracy::rmse},
                                                 {"rrmse", Metric::rrmse, &Accuracy::rrmse},
                                                 {"mrse", Metric::mrse, &Accuracy::mrse},
                                                 {"bias", Metric::bias, &Accuracy::bias},
                                                 {"flip", Metric::flip, &Accuracy::flip}}};

std::string refusal_of(const Report& base, const Report& now, const std::vector<Pair>& pairs,
                       const CompareOptions& options) {
  if (pairs.empty()) return "no case is in both reports and ok in both";
  if (base.device.name != now.device.name && !options.other_device && !options.ratios) {
    return fmt::format("the devices differ: '{}' and '{}'; --ratios compares what holds on both",
                       base.device.name, now.device.name);
  }
  for (const Pair& p : pairs) {
    if (!p.base->accuracy || !p.now->accuracy) continue;
    if (p.base->accuracy->reference.hash != p.now->accuracy->reference.hash) {
      return fmt::format("{}: the references differ ({} and {}), so the errors are of other things",
                         p.base->id, p.base->accuracy->reference.hash, p.now->accuracy->reference.hash);
    }
    for (const MetricField& f : kFields) {
      const MetricResult &b = (*p.base->accuracy).*f.result, &n = (*p.now->accuracy).*f.result;
      if (b.empty() || n.empty() || (b.formula == n.formula && b.constants == n.constants)) continue;
      return fmt::format("{}: {} has two formulas, '{}' and '{}'", p.base->id, f.name, b.formula, n.formula);
    }
  }
  return "";
}

std::map<PassStage, double> stages_of(const CaseResult& c) {
  std::map<PassStage, double> out;
  for (const PassTiming& p : c.passes) out[p.pass.stage] += p.ms.median;
  return out;
}

// How much longer everything takes in a scene, as a logarithm: the median over all stages of all its cases.
// Neither a stage that became slower in every case moves it, nor a method that did in every stage.
std::map<std::string, double> units_of(const std::vector<Pair>& pairs) {
  std::map<std::string, std::vector<double>> logs;
  for (const Pair& p : pairs) {
    const auto before = stages_of(*p.base), after = stages_of(*p.now);
    for (const auto& [stage, ms] : before) {
      const auto at = after.find(stage);
      if (at != after.end() && ms > 0 && at->second > 0)
        logs[p.base->scene].push_back(std::log(at->second / ms));
    }
  }
  std::map<std::string, double> out;
  for (const auto& [scene, values] : logs) out[scene] = median(values);
  return out;
}

// By scene, what times of the new report are divided by, as a logarithm.
std::map<std::string, double> units_of(const std::vector<Pair>& pairs, const CompareOptions& options) {
  return options.ratios ? units_of(pairs) : std::map<std::string, double>();
}

double unit_in(const std::map<std::string, double>& units, const std::string& scene) {
  const auto at = units.find(scene);
  return at == units.end() ? 0 : at->second;
}

std::optional<std::vector<double>> samples_of(const CaseResult& c, double divisor) {
  const auto ms = time_of(c, "method");
  if (!ms || !(ms->min > 0)) return std::nullopt;
  std::vector<double> out = ms->samples;
  for (double& v : out) v /= divisor;
  return out;
}

void compare_times_of(const Report& base, const Report& now, const std::vector<Pair>& pairs,
                      const CompareOptions& options, Comparison* out) {
  const auto units = units_of(pairs, options);
  for (const Pair& p : pairs) {
    const auto b = samples_of(*p.base, 1), n = samples_of(*p.now, std::exp(unit_in(units, p.base->scene)));
    if (!b || !n) continue;
    TimeChange t{p.base->scene, p.base->id, "method", median_ratio(*n, *b), {}, 0.5, Change::same};
    t.noise = larger_noise(base, now, t.scene, "method");
    const double wins = superiority_of(*n, *b);
    t.superiority = std::max(wins, 1 - wins);
    t.change = time_change(t.ratio, t.noise.value_or(0), t.superiority);
    out->times.push_back(std::move(t));
  }
}

void compare_passes(const Report& base, const Report& now, const std::vector<Pair>& pairs,
                    const CompareOptions& options, Comparison* out) {
  std::map<std::string, std::vector<double>> logs;
  std::map<std::string, std::vector<double>> noise;  // where it is known
  const auto units = units_of(pairs, options);
  for (const Pair& p : pairs) {
    const double unit = unit_in(units, p.base->scene);
    for (const PassTiming& pass : p.base->passes) {
      const auto at = std::ranges::find(p.now->passes, pass.pass, &PassTiming::pass);
      if (at == p.now->passes.end() || !(pass.ms.median > 0) || !(at->ms.median > 0)) continue;
      logs[pass.pass.name()].push_back(std::log(at->ms.median / pass.ms.median) - unit);
      if (const auto n = noise_of_pass(base, now, p.base->scene, pass.pass))
        noise[pass.pass.name()].push_back(*n);
    }
  }
  for (const auto& [pass, values] : logs) {
    if (values.size() < 3) continue;  // nothing to resample
    TimeChange t{"", "", pass, geometric_mean(values), {}, 0, Change::same};
    if (const auto at = noise.find(pass); at != noise.end()) t.noise = median(at->second);
    const auto slower = static_cast<double>(std::ranges::count_if(values, [](double v) { return v > 0; }));
    const double share = slower / static_cast<double>(values.size());
    t.superiority = std::max(share, 1 - share);
    t.change = time_change(t.ratio, t.noise.value_or(0), t.superiority);
    out->passes.push_back(std::move(t));
  }
}

// What is compared of a metric: its own value; of bias the image's energy, which is above 0.
double size_of(Metric metric, double value) { return metric == Metric::bias ? 1 + value : value; }

std::vector<double> paired_logs(const Pair& p, Metric metric) {
  std::map<uint64_t, double> before;
  std::vector<double> logs;
  for (const SeedResult& s : p.base->seeds) {
    if (const auto v = s.errors.value(metric)) before[s.seed] = size_of(metric, *v);
  }
  for (const SeedResult& s : p.now->seeds) {
    const auto v = s.errors.value(metric);
    const auto at = before.find(s.seed);
    if (!v || at == before.end() || !(at->second > 0) || !(size_of(metric, *v) > 0)) continue;
    logs.push_back(std::log(size_of(metric, *v) / at->second));
  }
  return logs;
}

// Student's interval of the mean log ratio; a single seed has none, and its ratio is taken for exact: images
// are the same to the bit where nothing changed.
Ratio error_ratio(const std::vector<double>& logs) {
  const MeanEstimate m = mean_ci95(logs);
  return {std::exp(m.mean), {std::exp(m.ci95.lo), std::exp(m.ci95.hi)}};
}

Change error_change(Metric metric, const ErrorChange& e) {
  const double above = 1 + kSmallestEffect, below = 1 / above;
  if (e.ratio.ci95.lo >= below && e.ratio.ci95.hi <= above) return Change::same;
  if (e.ratio.ci95.lo <= above && e.ratio.ci95.hi >= below) return Change::ambiguous;
  if (metric == Metric::bias) return std::abs(e.now) > std::abs(e.base) ? Change::worse : Change::better;
  return e.ratio.value > 1 ? Change::worse : Change::better;
}

void compare_errors_of(const std::vector<Pair>& pairs, Comparison* out) {
  for (const Pair& p : pairs) {
    if (!p.base->accuracy || !p.now->accuracy) continue;
    for (const MetricField& f : kFields) {
      const MetricResult &b = (*p.base->accuracy).*f.result, &n = (*p.now->accuracy).*f.result;
      if (!b.value || !n.value) continue;
      const std::vector<double> logs = paired_logs(p, f.metric);
      if (logs.empty()) continue;
      ErrorChange e{p.base->id, f.name, *b.value, *n.value, error_ratio(logs), Change::same};
      e.change = error_change(f.metric, e);
      out->errors.push_back(std::move(e));
    }
  }
}

}  // namespace

std::string_view name(Change change) {
  static constexpr std::array names = {"faster", "slower", "better", "worse", "same", "ambiguous"};
  return names.at(static_cast<size_t>(change));
}

bool is_regression(Change change) { return change == Change::slower || change == Change::worse; }

int Comparison::exit_code() const {
  if (!refusal.empty()) return 5;
  const auto regressed = [](const auto& c) { return is_regression(c.change); };
  if (!broken.empty() || std::ranges::any_of(errors, regressed)) return 4;
  if (byte_equal) return 0;
  if (std::ranges::any_of(passes, regressed) || std::ranges::any_of(times, regressed)) return 4;
  // What may be faster or the same is no worse.
  const auto unclear = [](const TimeChange& t) {
    return t.change == Change::ambiguous &&
           t.ratio.ci95.hi > 1 + std::max(t.noise.value_or(0), kSmallestEffect);
  };
  return std::ranges::any_of(passes, unclear) ? 5 : 0;
}

Comparison compare_reports(const Report& base, const Report& now, const CompareOptions& options) {
  Comparison out;
  const std::vector<Pair> pairs = pair_up(base, now, &out);
  out.refusal = refusal_of(base, now, pairs, options);
  if (!out.refusal.empty()) return out;
  out.byte_equal = !base.kernels.empty() && base.kernels == now.kernels &&
                   base.device.name == now.device.name &&
                   base.device.driver_version == now.device.driver_version;
  compare_passes(base, now, pairs, options, &out);
  compare_times_of(base, now, pairs, options, &out);
  compare_errors_of(pairs, &out);
  return out;
}

}  // namespace vsglbench
