// Cases are paired by id, seeds by number.
#include "answer/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "answer/compare_times.h"
#include "base/error.h"

namespace vsglbench {
namespace {

std::map<std::string, const CaseResult*> by_id(const Report& report) {
  std::map<std::string, const CaseResult*> out;
  for (const CaseResult& c : report.cases) out[c.id] = &c;
  return out;
}

std::vector<CasePair> pair_up(const Report& base, const Report& now, Comparison* out) {
  const auto before = by_id(base), after = by_id(now);
  std::vector<CasePair> pairs;
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

// A setting that is in no case's name, as of `run --set`: "skip_effects '' and 'occlusion'". Empty: none; a
// key that one of the two does not know is not compared.
std::string other_setting(const CaseResult& base, const CaseResult& now) {
  for (const auto& [key, value] : base.parameters.items()) {
    if (!now.parameters.contains(key) || now.parameters.at(key) == value) continue;
    return fmt::format("{} {} and {}", key, value.dump(), now.parameters.at(key).dump());
  }
  return "";
}

std::string refusal_of(const Report& base, const Report& now, const std::vector<CasePair>& pairs,
                       const CompareOptions& options) {
  if (pairs.empty()) return "no case is in both reports and ok in both";
  if (base.device.name != now.device.name && !options.other_device && !options.ratios) {
    return fmt::format("the devices differ: '{}' and '{}'; --ratios compares what holds on both",
                       base.device.name, now.device.name);
  }
  for (const CasePair& p : pairs) {
    const std::string setting = options.other_settings ? "" : other_setting(*p.base, *p.now);
    if (!setting.empty()) {
      return fmt::format("{}: the settings differ, {}; --other-settings compares all the same", p.base->id,
                         setting);
    }
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

// What is compared of a metric: its own value; of bias the image's energy, which is above 0.
double size_of(Metric metric, double value) { return metric == Metric::bias ? 1 + value : value; }

std::vector<double> paired_logs(const CasePair& p, Metric metric) {
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

void compare_errors_of(const std::vector<CasePair>& pairs, Comparison* out) {
  for (const CasePair& p : pairs) {
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

bool may_be_slower(const TimeChange& t) {
  return t.change == Change::ambiguous &&
         t.ratio.ci95.hi > 1 + std::max(t.noise.value_or(0), kSmallestEffect);
}

bool is_regression(Change change) { return change == Change::slower || change == Change::worse; }

int Comparison::exit_code() const {
  if (!refusal.empty()) return 5;
  const auto regressed = [](const auto& c) { return is_regression(c.change); };
  if (!broken.empty() || std::ranges::any_of(errors, regressed)) return 4;
  if (byte_equal) return 0;
  for (const auto* list : {&passes, &method_passes, &times}) {
    if (std::ranges::any_of(*list, regressed)) return 4;
  }
  // What may be faster or the same is no worse, nor a pass that is unclear over all cases, and clear in every
  // method by itself.
  const auto unclear = [&](const TimeChange& t) {
    const auto is_of = [&](const TimeChange& m) { return m.time == t.time; };
    const auto is_unclear = [&](const TimeChange& m) { return is_of(m) && may_be_slower(m); };
    return may_be_slower(t) &&
           (std::ranges::none_of(method_passes, is_of) || std::ranges::any_of(method_passes, is_unclear));
  };
  return std::ranges::any_of(passes, unclear) ? 5 : 0;
}

Comparison compare_reports(const Report& base, const Report& now, const CompareOptions& options) {
  Comparison out;
  const std::vector<CasePair> pairs = pair_up(base, now, &out);
  out.refusal = refusal_of(base, now, pairs, options);
  if (!out.refusal.empty()) return out;
  out.byte_equal = !base.kernels.empty() && base.kernels == now.kernels &&
                   base.device.name == now.device.name &&
                   base.device.driver_version == now.device.driver_version;
  compare_times_of(base, now, pairs, options, &out);
  compare_errors_of(pairs, &out);
  return out;
}

}  // namespace vsglbench
