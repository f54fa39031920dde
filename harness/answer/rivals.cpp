#include "answer/rivals.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "answer/front.h"
#include "base/error.h"
#include "base/nearest.h"

namespace vsglbench {
namespace {

bool is_of(const Point& p, const std::string& method) { return p.result->method == method; }

bool is_papers_vsgl(const Point& p, const std::string& method) {
  if (is_of(p, method) || is_of(p, "all-texels")) return false;
  const Json shading = p.result->parameters.value("shading", Json());
  return shading == "vsgl14" || shading == "vsgl16";
}

// The id without scene and method, which the row has.
std::string settings(const Point& p) {
  const std::string& id = p.result->id;
  const size_t second = id.find('/', id.find('/') + 1);
  return second == std::string::npos ? id : id.substr(second + 1);
}

// This point among those of other methods: place() would have it dominated by the method's own, too.
Placed among_others(const PointGroup& group, const Point& point, const std::string& method) {
  PointGroup others = group;
  std::erase_if(others.points, [&](const Point& p) { return is_of(p, method) && p.result != point.result; });
  const auto placed = place(others);
  for (const Placed& at : placed) {
    if (others.points[at.point].result == point.result) {
      Placed out = at;
      // Indices of `group`, which lasts.
      for (size_t& by : out.by) {
        by = std::ranges::find(group.points, others.points[by].result, &Point::result) - group.points.begin();
      }
      return out;
    }
  }
  return {};
}

Rivalry rivalry(const PointGroup& group, const std::string& method, const std::string& metric) {
  Rivalry r{
      .scene = group.scene, .visibility = group.visibility, .reference = group.reference, .metric = metric};
  std::vector<size_t> papers;
  for (size_t i = 0; i < group.points.size(); ++i) {
    if (is_papers_vsgl(group.points[i], method)) papers.push_back(i);
  }
  const auto stairs = staircase(group, papers);
  for (const Point& p : group.points) {
    if (!is_of(p, method)) continue;
    const Placed placed = among_others(group, p, method);
    if (placed.standing == Standing::front) ++r.undominated;
    if (placed.standing != Standing::front) {
      std::string by;
      if (!placed.by.empty()) {
        const Point& first = group.points.at(placed.by.front());
        by = fmt::format(" by {} {}", first.result->method, settings(first));
      }
      auto& list = placed.standing == Standing::dominated ? r.dominated : r.ambiguous;
      list.push_back(settings(p) + by);
    }
    if (const auto theirs = error_at(group, stairs, p.ms.value); theirs && *theirs > 0)
      r.at_equal_time.push_back(p.error.value / *theirs);
  }
  return r;
}

// "0.62 [0.55, 0.71] of 3"
std::string ratios(const std::vector<double>& values) {
  if (values.empty()) return "-";
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  const auto [least, most] = std::ranges::minmax(values);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}] of {}", std::exp(sum / static_cast<double>(values.size())),
                     least, most, values.size());
}

}  // namespace

std::vector<Rivalry> rivalries(const Report& report, const RivalQuestion& question) {
  std::set<std::string> names, scenes;
  for (const CaseResult& c : report.cases) {
    names.insert(c.method);
    if (c.method == question.method) scenes.insert(c.scene);
  }
  if (!names.contains(question.method)) {
    throw fail(ErrorKind::usage, "the report has no method '{}'{}", question.method,
               suggestion(question.method, std::vector(names.begin(), names.end())));
  }
  if (!question.scene.empty() && !scenes.contains(question.scene)) {
    throw fail(ErrorKind::usage, "the report has no scene '{}' with '{}'{}", question.scene, question.method,
               suggestion(question.scene, std::vector(scenes.begin(), scenes.end())));
  }
  const auto asked_for = [&](const PointGroup& group) {
    return (question.scene.empty() || group.scene == question.scene) &&
           (question.visibility.empty() || group.visibility == question.visibility) &&
           std::ranges::any_of(group.points, [&](const Point& p) { return is_of(p, question.method); });
  };
  std::vector<Rivalry> out;
  for (const std::string& metric : question.metrics) {
    for (const PointGroup& group : point_groups(report, {metric, question.time})) {
      if (asked_for(group)) out.push_back(rivalry(group, question.method, metric));
    }
  }
  if (out.empty()) {
    throw fail(ErrorKind::usage, "the report has no case of '{}' with errors, times and visibility '{}'",
               question.method, question.visibility.empty() ? "none or full" : question.visibility);
  }
  // By group, the metrics in their order.
  std::ranges::stable_sort(out, [&](const Rivalry& a, const Rivalry& b) {
    const auto first = [&](const Rivalry& r) {
      return std::ranges::find_if(report.cases, [&](const CaseResult& c) { return c.scene == r.scene; });
    };
    return std::tuple(first(a), a.visibility, a.reference) < std::tuple(first(b), b.visibility, b.reference);
  });
  return out;
}

std::string rivalry_table(const std::vector<Rivalry>& rivalries) {
  std::vector<std::string> metrics;
  for (const Rivalry& r : rivalries) {
    if (std::ranges::count(metrics, r.metric) == 0) metrics.push_back(r.metric);
  }
  if (metrics.empty()) return "";
  std::string head = "| view | visibility |", rule = "| --- | --- |";
  for (const std::string& m : metrics) {
    head += fmt::format(" {}: not dominated / can't be told / dominated |", m);
    rule += " ---: |";
  }
  std::string text =
      fmt::format("{} {} at equal time, papers' VSGLs = 1 |\n{} ---: |\n", head, metrics[0], rule);
  std::string dominated, ambiguous;
  for (size_t i = 0; i < rivalries.size();) {
    const Rivalry& first = rivalries[i];
    text += fmt::format("| {} | {} |", first.scene, first.visibility);
    for (; i < rivalries.size() && rivalries[i].scene == first.scene &&
           rivalries[i].visibility == first.visibility && rivalries[i].reference == first.reference;
         ++i) {
      const Rivalry& r = rivalries[i];
      text += fmt::format(" {} / {} / {} |", r.undominated, r.ambiguous.size(), r.dominated.size());
      const auto add = [&r](const std::vector<std::string>& points, std::string* lines) {
        for (const std::string& point : points)
          *lines += fmt::format("* {}, {}, {}: {}\n", r.scene, r.visibility, r.metric, point);
      };
      add(r.dominated, &dominated);
      add(r.ambiguous, &ambiguous);
    }
    text += fmt::format(" {} |\n", ratios(first.at_equal_time));
  }
  text +=
      "\nAt equal time: the geometric mean of the points' ratios, their range, and how many they are.\n\n";
  text += dominated.empty() ? "No point is dominated.\n" : "Dominated:\n\n" + dominated;
  return ambiguous.empty() ? text : text + "\nCan't be told:\n\n" + ambiguous;
}

}  // namespace vsglbench
