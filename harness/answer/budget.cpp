#include "answer/budget.h"

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

bool same_image_size(const CaseResult& a, const CaseResult& b) {
  for (const char* key : {"rsm", "width", "height"}) {
    if (text(a, key) != text(b, key)) return false;
  }
  return true;
}

class Search {
 public:
  Search(const Report& report, const CaseResult& c, const std::string& metric)
      : report_(report), case_(c), metric_(metric) {}

  const CaseResult* all_texels(const std::string& shading) const {
    return find([&](const CaseResult& c) {
      return c.method == "all-texels" && text(c, "visibility") == "none" && shading_of(c) == shading &&
             same_image_size(c, case_);
    });
  }
  // The case itself with another visibility.
  const CaseResult* seen_by(const std::string& visibility) const {
    Json wanted = case_.parameters;
    wanted["visibility"] = visibility;
    return find([&](const CaseResult& c) { return c.method == case_.method && c.parameters == wanted; });
  }

 private:
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
    part = {name, c->id, "", error, error.value};
    for (auto above = budget->parts.rbegin(); above != budget->parts.rend(); ++above) {
      if (!above->error) continue;
      *part.increment -= above->error->value;
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
  add(&budget, metric, "RSM resolution", search.all_texels("exact"),
      "all-texels, shading exact, visibility none");
  if (shading != "exact")
    add(&budget, metric, "SG lobes", search.all_texels(shading),
        fmt::format("all-texels, shading {}, visibility none", shading));
  if (c.method != "all-texels")
    add(&budget, metric, "clustering", search.seen_by("none"), "this case with visibility none");
  if (visibility != "none")
    add(&budget, metric, "visibility test", search.seen_by("exact"), "this case with visibility exact");
  if (visibility != "none" && visibility != "exact") add(&budget, metric, "shadow maps", &c, "");
  if (c.generate && c.generate->flux) budget.flux_lost = 1 - c.generate->flux->value;
  return budget;
}

}  // namespace vsglbench
