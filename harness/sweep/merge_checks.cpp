#include <algorithm>

#include "sweep/merge.h"

namespace vsglbench {
namespace {

Json without_only(Json config) {
  config.erase("only");
  return config;
}

std::vector<std::pair<std::string, std::string>> formulas_of(const CaseResult& c) {
  std::vector<std::pair<std::string, std::string>> out;
  if (c.accuracy) {
    const Accuracy& a = *c.accuracy;
    out = {{"smape", a.smape.formula}, {"rmse", a.rmse.formula}, {"rrmse", a.rrmse.formula},
           {"mrse", a.mrse.formula},   {"bias", a.bias.formula}, {"smape_lit", a.smape_lit.formula},
           {"flip", a.flip.formula}};
  }
  if (c.temporal) {
    out.emplace_back("flicker", c.temporal->derivative.formula);
    if (c.temporal->still) out.emplace_back("static flicker", c.temporal->still->formula);
    if (c.temporal->detail) out.emplace_back("detail", c.temporal->detail->formula);
  }
  return out;
}

// Cases of one scene, size and occlusion have one reference.
std::string reference_of(const CaseResult& c) {
  const Json& p = c.parameters;
  return fmt::format("the reference of {} at {}x{}{}", c.scene, p.value("width", 0), p.value("height", 0),
                     p.value("visibility", "") == "none" ? " without occlusion" : "");
}

}  // namespace

std::string MergeChecks::other_than_planned(size_t shard, const Report& r) const {
  if (without_only(r.config) != without_only(plan_.config)) return "was measured from another config";
  if (r.kernels != plan_.kernels) return "was measured with other kernels or methods";
  if (r.git.commit != plan_.git.commit || r.git.dirty != plan_.git.dirty)
    return fmt::format("was measured by another programme, commit {}", r.git.commit.substr(0, 7));
  if (!r.complete) return "is the report of an interrupted run";
  std::vector<std::string> ids, planned = plan_.shards[shard].cases;
  for (const CaseResult& c : r.cases) ids.push_back(c.id);
  std::ranges::sort(ids);
  std::ranges::sort(planned);
  return ids == planned ? "" : "has other cases than its shard";
}

// `what` has one value in all shards.
std::string MergeChecks::agree(const std::string& what, const std::string& value, const std::string& folder) {
  const auto [first, fresh] = common_.emplace(what, std::pair(value, folder));
  if (fresh || first->second.first == value) return "";
  return fmt::format("{} is '{}', and '{}' in {}", what, value, first->second.first, first->second.second);
}

std::string MergeChecks::problem(size_t shard, const std::string& folder, const Report& report) {
  if (const std::string other = other_than_planned(shard, report); !other.empty()) return other;
  for (const SceneReport& scene : report.scenes)
    if (const std::string p = agree("the hash of scene " + scene.name, scene.hash, folder); !p.empty())
      return p;
  for (const CaseResult& c : report.cases) {
    for (const auto& [metric, formula] : formulas_of(c))
      if (const std::string p = agree("the formula of " + metric, formula, folder); !p.empty()) return p;
    if (!c.accuracy) continue;
    if (const std::string p = agree(reference_of(c), c.accuracy->reference.hash, folder); !p.empty())
      return p;
  }
  return "";
}

}  // namespace vsglbench
