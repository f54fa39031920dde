#include "answer/claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "answer/claim_pairs.h"
#include "answer/claim_values.h"
#include "base/error.h"
#include "base/file.h"
#include "report/case_names.h"

namespace vsglbench {
namespace {

// --- rulings ---

enum class Truth { so, not_so, open };

// Whether a ratio in this interval of logarithms is as said.
Truth truth_of(const PaperClaim& claim, const Interval& log) {
  const double factor = std::log(claim.factor), step = std::log1p(kSmallestEffect);
  switch (claim.says) {
    case Says::less:
      return log.hi < factor - step ? Truth::so : log.lo > factor - step ? Truth::not_so : Truth::open;
    case Says::no_more:
      return log.hi <= factor + step ? Truth::so : log.lo > factor + step ? Truth::not_so : Truth::open;
    case Says::more:
      return log.lo > factor + step ? Truth::so : log.hi < factor + step ? Truth::not_so : Truth::open;
  }
  throw std::logic_error("says nothing");
}

// Mean over pairs, seed by seed, of the seeds that all have; of times, of estimates and ends.
Estimate pooled(const std::vector<PairRatio>& pairs) {
  const auto count = static_cast<double>(pairs.size());
  Estimate mean;
  const bool of_pairs = std::ranges::any_of(pairs, &PairRatio::of_pairs);
  std::map<uint64_t, std::pair<double, size_t>> sums;
  for (const PairRatio& p : pairs) {
    mean.value += p.log.value / count;
    mean.ci95.lo += p.log.ci95.lo / count;
    mean.ci95.hi += p.log.ci95.hi / count;
    for (const auto& [seed, log] : p.by_seed) {
      sums[seed].first += log / count;
      sums[seed].second++;
    }
  }
  std::erase_if(sums, [&](const auto& s) { return s.second.second < pairs.size(); });
  std::map<uint64_t, double> logs;
  for (const auto& [seed, sum] : sums) logs[seed] = sum.first;
  return mean_of_seeds(logs, of_pairs).value_or(mean);
}

Ruling ruling_of(Truth whole, size_t holding, size_t contrary) {
  if (holding > 0 && contrary > 0) return Ruling::in_part;
  if (whole == Truth::so && contrary == 0) return Ruling::holds;
  if (whole == Truth::not_so && holding == 0) return Ruling::does_not_hold;
  return Ruling::undecided;
}

// Of these a seed may have 0 or less, which has no logarithm.
bool may_be_0(const std::string& metric) {
  return metric.ends_with("detail") || metric == "cancellation_rate";
}

std::string what_is_missing(const Sides& sides, const PaperClaim& claim, const std::string& metric) {
  for (const auto& [side, settings] : {std::pair(&sides.a, &claim.a), std::pair(&sides.b, &claim.b)}) {
    if (!side->empty()) continue;
    const std::string gap = settings->empty() || claim.both.empty() ? "" : " ";
    return "no case of " + settings_text(*settings) + gap + settings_text(claim.both) +
           (claim.step.empty() ? "" : " with " + claim.step);
  }
  const auto still = [](const ClaimCase& t) { return !t.result->temporal; };
  if (is_temporal(metric) && (std::ranges::all_of(sides.a, still) || std::ranges::all_of(sides.b, still)))
    return "was not measured in motion";
  const auto measured = [&](const ClaimCase& t) {
    return is_time(metric) ? t.ms.has_value() : t.logs.size() > 1;
  };
  for (const auto& [side, settings] : {std::pair(&sides.a, &claim.a), std::pair(&sides.b, &claim.b)}) {
    if (std::ranges::any_of(*side, measured)) continue;
    if (const auto glob = pass_glob(metric))
      return fmt::format("no pass of {} that takes time is named {}", settings_text(*settings), *glob);
    return fmt::format("{} was not measured{}", metric,
                       is_time(metric)               ? ""
                       : metric == "temporal.static" ? " for three seeds"
                       : may_be_0(metric)            ? " above 0 for two seeds"
                                                     : " for two seeds");
  }
  const auto none = [&](const ClaimCase& t) { return has_none(*t.result, metric); };
  if (std::ranges::all_of(sides.a, none) && std::ranges::all_of(sides.b, none))
    return metric + " is 0 in every seed of both sides";
  if (!claim.step.empty()) return "no two cases alike in all but " + claim.step;
  return claim.equal_time ? "no two cases alike in all else whose times meet"
                          : "no two cases alike in all else";
}

ClaimRow row_of(const Report& report, const PaperClaim& claim, const std::string& scene,
                const std::string& metric) {
  ClaimRow row;
  row.scene = scene;
  row.metric = metric;
  const double noise = claimed_noise(report, scene, metric);
  const Sides sides = sides_of(report, claim, scene, metric);
  const std::vector<PairRatio> pairs = pairs_of(claim, sides, metric, noise);
  if (pairs.empty()) {
    row.why = what_is_missing(sides, claim, metric);
    return row;
  }
  row.pairs = pairs.size();
  row.lowest = row.highest = std::exp(pairs.front().log.value);
  for (const PairRatio& p : pairs) {
    const Truth truth = truth_of(claim, p.log.ci95);
    row.holding += truth == Truth::so;
    row.contrary += truth == Truth::not_so;
    row.lowest = std::min(row.lowest, std::exp(p.log.value));
    row.highest = std::max(row.highest, std::exp(p.log.value));
  }
  const Estimate whole = pooled(pairs);
  row.ratio = std::exp(whole.value);
  row.ci95 = {std::exp(whole.ci95.lo), std::exp(whole.ci95.hi)};
  row.ruling = ruling_of(truth_of(claim, whole.ci95), row.holding, row.contrary);
  return row;
}

}  // namespace

std::string_view name(Ruling ruling) {
  switch (ruling) {
    case Ruling::holds:
      return "holds";
    case Ruling::does_not_hold:
      return "does not hold";
    case Ruling::in_part:
      return "in part";
    case Ruling::undecided:
      return "undecided";
    case Ruling::not_run:
      return "not run";
  }
  throw std::logic_error("no such ruling");
}

std::vector<PaperClaim> load_claims(const std::filesystem::path& file) {
  const auto folder = data_root() / "harness" / "answer";
  static const Json schema = JsonDocument::load(folder / "claims.schema.json", ErrorKind::output).root();
  const JsonDocument doc =
      JsonDocument::load(file.empty() ? folder / "claims.json" : file, ErrorKind::config);
  check_schema(doc, schema);
  std::vector<PaperClaim> out;
  for (const Json& j : doc.root().at("claims")) {
    PaperClaim c;
    c.name = j.at("name");
    c.text = j.at("text");
    c.source = j.at("source");
    c.both = j.value("both", Json::object());
    c.a = j.at("a");
    c.b = j.at("b");
    c.step = j.value("step", "");
    c.says = j.at("says") == "less" ? Says::less : j.at("says") == "more" ? Says::more : Says::no_more;
    c.factor = j.value("factor", 1.0);
    c.equal_time = j.value("at", "equal N") == "equal time";
    c.metrics = j.at("metrics").get<std::vector<std::string>>();
    c.scenes = j.value("scenes", std::vector<std::string>{"*"});
    out.push_back(std::move(c));
  }
  return out;
}

TriedClaim try_claim(const Report& report, const PaperClaim& claim) {
  TriedClaim out{claim, {}};
  std::vector<std::string> scenes;
  for (const CaseResult& c : report.cases) {
    const auto meant = [&](const std::string& glob) { return matches_glob(c.scene, glob); };
    if (std::ranges::count(scenes, c.scene) == 0 && std::ranges::any_of(claim.scenes, meant))
      scenes.push_back(c.scene);
  }
  for (const std::string& scene : scenes) {
    for (const std::string& metric : claim.metrics) out.rows.push_back(row_of(report, claim, scene, metric));
  }
  return out;
}

}  // namespace vsglbench
