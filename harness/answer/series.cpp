#include "answer/series.h"

#include <algorithm>
#include <map>
#include <set>

namespace vsglbench {
namespace {

// The method and every parameter but one, as text.
std::string rest_of(const CaseResult& c, const std::string& key) {
  std::string out = c.method;
  for (const auto& item : c.parameters.items()) {
    if (item.key() != key) out += '\n' + item.key() + '=' + item.value().dump();
  }
  return out;
}

void sort_values(const PointGroup& group, Series* series) {
  std::ranges::sort(series->points, {}, [&](const auto& v) { return group.points[v.second].result; });
  std::ranges::stable_sort(series->points, [](const auto& a, const auto& b) {
    return a.first.is_number() && b.first.is_number() &&
           a.first.template get<double>() < b.first.template get<double>();
  });
}

}  // namespace

std::vector<std::string> varied_keys(const PointGroup& group) {
  std::map<std::string, const Json*> first;
  std::set<std::string> out;
  for (const Point& p : group.points) {
    for (const auto& item : p.result->parameters.items()) {
      if (item.value().is_structured()) continue;
      const auto known = first.try_emplace(item.key(), &item.value()).first;
      if (*known->second != item.value()) out.insert(item.key());
    }
  }
  return {out.begin(), out.end()};
}

std::vector<Series> series_over(const PointGroup& group, const std::string& key) {
  std::map<std::string, Series> by_rest;
  for (size_t i = 0; i < group.points.size(); ++i) {
    const CaseResult& c = *group.points[i].result;
    const auto value = c.parameters.find(key);
    if (value != c.parameters.end() && !value->is_structured())
      by_rest[rest_of(c, key)].points.emplace_back(*value, i);
  }
  std::vector<Series> out;
  for (auto& [rest, series] : by_rest) {
    sort_values(group, &series);
    out.push_back(std::move(series));
  }
  return out;
}

}  // namespace vsglbench
