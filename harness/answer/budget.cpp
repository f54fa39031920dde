#include "answer/budget.h"

#include <set>

#include "base/error.h"

namespace vsglbench {
namespace {

std::string text(const CaseResult& c, const char* key) {
  const auto at = c.parameters.find(key);
  if (at == c.parameters.end()) return "";
  return at->is_string() ? at->get<std::string>() : at->dump();
}

// The case's shading with the keys that steer it; VPLs have exact BRDFs.
std::string shading_of(const CaseResult& c) {
  const std::string shading = text(c, "shading");
  return shading.empty() ? "exact" : shading;
}

// What describes how lights see and are seen, not what they are.
bool is_of_visibility(const std::string& key) { return key == "visibility" || key == "light_clearance"; }

// What steers SGs alone; exact BRDFs don't read it.
bool is_of_lobes(const std::string& key) {
  static const std::set<std::string> keys = {
      "bias_reduction", "shading",  "lobe_filter", "diffuse",
      "lobes",          "variance", "receiver",    "lambert_sharpness"};
  return keys.contains(key);
}

// The keys that both have and in which they are not alike, of what makes the picture but for how the lights
// were chosen: that all-texels does not have.
std::vector<std::string> differing(const CaseResult& c, const CaseResult& texels, bool with_lobes) {
  std::vector<std::string> out;
  for (const auto& item : texels.parameters.items()) {
    const std::string& key = item.key();
    const auto own = c.parameters.find(key);
    if (own == c.parameters.end() || is_of_visibility(key) || key == "shading") continue;
    if ((with_lobes || !is_of_lobes(key)) && *own != item.value()) out.push_back(key);
  }
  return out;
}

class Search {
 public:
  Search(const Report& report, const CaseResult& c, const std::string& metric)
      : report_(report), case_(c), metric_(metric) {}

  const CaseResult* all_texels(const std::string& shading) const {
    return find([&](const CaseResult& c) {
      return is_texels(c, shading) && differing(case_, c, shading != "exact").empty();
    });
  }
  // "all-texels, shading vsgl16, visibility none", and in which keys the one that is there differs.
  std::string missing_texels(const std::string& shading) const {
    const std::string out = fmt::format("all-texels, shading {}, visibility none", shading);
    const CaseResult* like = find([&](const CaseResult& c) { return is_texels(c, shading); });
    if (!like) return out;
    std::vector<std::string> keys;
    for (const std::string& key : differing(case_, *like, shading != "exact"))
      keys.push_back(key + " " + text(case_, key.c_str()));
    return fmt::format("{}, {}", out, fmt::join(keys, ", "));
  }
  // The case itself with another visibility, and where that is none, whatever its clearance.
  const CaseResult* seen_by(const std::string& visibility) const {
    const auto rest = [&](Json parameters) {
      parameters.erase("visibility");
      if (visibility == "none") parameters.erase("light_clearance");
      return parameters;
    };
    const Json wanted = rest(case_.parameters);
    return find([&](const CaseResult& c) {
      return c.method == case_.method && text(c, "visibility") == visibility && rest(c.parameters) == wanted;
    });
  }

 private:
  static bool is_texels(const CaseResult& c, const std::string& shading) {
    return c.method == "all-texels" && text(c, "visibility") == "none" && shading_of(c) == shading;
  }
  template <class F>
  const CaseResult* find(F matches) const {
    for (const CaseResult& c : report_.cases) {
      if (c.status == Status::ok && c.scene == case_.scene && c.accuracy && metric_of(*c.accuracy, metric_) &&
          matches(c))
        return &c;
    }
    return nullptr;
  }
  const Report& report_;
  const CaseResult& case_;
  const std::string& metric_;
};

void add(Budget* budget, const std::string& metric, const std::string& name, const CaseResult* c,
         const std::string& missing) {
  BudgetPart part{name, "", missing, {}, {}};
  if (c) {
    const Estimate error = *error_of(*c, metric);
    part = {name, c->id, "", error, {}};
    if (budget->parts.empty()) part.increment = error.value;
    for (auto above = budget->parts.rbegin(); above != budget->parts.rend(); ++above) {
      if (!above->error) continue;
      part.increment = error.value - above->error->value;
      break;
    }
  }
  budget->parts.push_back(std::move(part));
}

}  // namespace

Budget error_budget(const Report& report, const CaseResult& c, const AnswerOptions& options) {
  const std::string& metric = options.metric;
  if (!c.accuracy || !metric_of(*c.accuracy, metric))
    throw fail(ErrorKind::usage, "{}: has no {} to divide", c.id, metric_title(metric));
  const Search search(report, c, metric);
  const std::string shading = shading_of(c), visibility = text(c, "visibility");
  Budget budget{c.id, {}, {}};
  add(&budget, metric, "RSM resolution", search.all_texels("exact"), search.missing_texels("exact"));
  if (shading != "exact")
    add(&budget, metric, "SG lobes", search.all_texels(shading), search.missing_texels(shading));
  if (c.method != "all-texels")
    add(&budget, metric, "clustering", search.seen_by("none"), "this case with visibility none");
  if (visibility != "none")
    add(&budget, metric, "visibility test", search.seen_by("exact"), "this case with visibility exact");
  if (visibility != "none" && visibility != "exact") add(&budget, metric, "shadow maps", &c, "");
  if (c.generate && c.generate->flux) budget.flux_lost = 1 - c.generate->flux->value;
  return budget;
}

}  // namespace vsglbench
