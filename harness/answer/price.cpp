#include "answer/price.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "answer/series.h"

namespace vsglbench {
namespace {

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::map<std::string, double> medians(const CaseResult& c) {
  std::map<std::string, double> out;
  for (const PassTiming& p : c.passes) {
    if (p.pass.stage != PassStage::draw) out[p.pass.name()] = p.ms.median;
  }
  return out;
}

// The raster of the two halves is in no method's hands.
void find_pass(const CaseResult& before, const CaseResult& after, Price* price) {
  const auto a = medians(before), b = medians(after);
  std::set<std::string> names;
  for (const auto* passes : {&a, &b}) {
    for (const auto& [name, ms] : *passes) names.insert(name);
  }
  const auto of = [](const auto& passes, const std::string& name) {
    const auto at = passes.find(name);
    return at == passes.end() ? 0.0 : at->second;
  };
  for (const std::string& name : names) {
    const double change = of(b, name) - of(a, name);
    if (std::abs(change) <= std::abs(price->pass_ms)) continue;
    price->pass = name;
    price->pass_ms = change;
  }
}

Price price_of(const PointGroup& group, const std::string& key, const std::pair<Json, size_t>& from,
               const std::pair<Json, size_t>& to) {
  const Point &a = group.points[from.second], &b = group.points[to.second];
  Price p{key,
          text_of(from.first),
          text_of(to.first),
          from.second,
          to.second,
          b.error.value - a.error.value,
          b.ms.value - a.ms.value,
          compare_errors(b, a),
          compare_costs(b, a, group.noise),
          "",
          0};
  find_pass(*a.result, *b.result, &p);
  return p;
}

}  // namespace

std::optional<double> Price::error_per_ms() const {
  if (cost_change == Relation::same || ms == 0) return std::nullopt;
  return -error / ms;
}

std::vector<Price> prices(const PointGroup& group) {
  std::vector<Price> out;
  for (const std::string& key : varied_keys(group)) {
    const size_t first = out.size();
    for (const Series& series : series_over(group, key)) {
      const auto& values = series.points;
      const bool numbers = values.front().first.is_number();
      for (size_t k = 1; k < values.size(); ++k) {
        const auto& from = values[numbers ? k - 1 : 0];
        if (from.first != values[k].first) out.push_back(price_of(group, key, from, values[k]));
      }
    }
    std::stable_sort(out.begin() + static_cast<ptrdiff_t>(first), out.end(),
                     [](const Price& a, const Price& b) { return a.before < b.before; });
  }
  return out;
}

std::vector<KnobSummary> knob_summaries(const PointGroup& group, const std::vector<Price>& prices) {
  std::map<std::string, std::vector<const Price*>> by_key;
  for (const Price& p : prices) by_key[p.key].push_back(&p);
  std::vector<KnobSummary> out;
  for (const auto& [key, pairs] : by_key) {
    KnobSummary s{key, 0, 0, 0, ""};
    std::map<std::string, size_t> payers;
    for (const Price* p : pairs) {
      const Point &a = group.points[p->before], &b = group.points[p->after];
      if (!(a.error.value > 0) || !(b.error.value > 0)) continue;
      ++s.pairs;
      s.error_ratio += std::log(b.error.value / a.error.value);
      s.cost_ratio += std::log(b.ms.value / a.ms.value);
      ++payers[p->pass];
    }
    if (s.pairs == 0) continue;
    s.error_ratio = std::exp(s.error_ratio / static_cast<double>(s.pairs));
    s.cost_ratio = std::exp(s.cost_ratio / static_cast<double>(s.pairs));
    s.pass = std::ranges::max_element(payers, {}, [](const auto& p) { return p.second; })->first;
    out.push_back(std::move(s));
  }
  return out;
}

}  // namespace vsglbench
