#include "answer/reply.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "answer/front.h"
#include "base/error.h"
#include "base/nearest.h"
#include "report/case_names.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

double number_in(const std::string& text, const std::string& whole, const char* like) {
  size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used == 0 || text.find_first_not_of(' ', used) != std::string::npos || !(value > 0) ||
      !std::isfinite(value))
    throw fail(ErrorKind::usage, "'{}' is no bound; give one like {}", whole, like);
  return value;
}

std::string number(double v) { return v < 1000 ? fmt::format("{:.3g}", v) : fmt::format("{:.0f}", v); }

std::string with_interval(const Estimate& e, const std::string& unit) {
  return fmt::format("{}{} [{}, {}]", number(e.value), unit, number(e.ci95.lo), number(e.ci95.hi));
}

// A time that few frames were measured of has no interval to speak of.
std::string time_text(const Point& p) {
  if (p.frames >= kFewFrames) return with_interval(p.ms, "");
  return fmt::format("{} ({} frame{})", number(p.ms.value), p.frames, p.frames == 1 ? "" : "s");
}

class Answer {
 public:
  Answer(const Report& report, const Question& question, const PointGroup& group)
      : report_(report), question_(question), group_(group), names_(cases(group)) {
    for (size_t i = 0; i < group.points.size(); ++i) {
      if (fits(group.points[i])) fitting_.push_back(i);
    }
    std::ranges::stable_sort(fitting_, {}, [&](size_t i) { return rank(group_.points[i]); });
  }

  std::string text() const {
    if (!question_.error && !question_.ms) return summary() + "\n";
    std::string out = sentence() + "\n";
    if (fitting_.empty()) return out;
    return out + table();
  }

 private:
  static std::vector<const CaseResult*> cases(const PointGroup& group) {
    std::vector<const CaseResult*> out;
    for (const Point& p : group.points) out.push_back(p.result);
    return out;
  }
  bool by_error() const { return question_.error.has_value(); }
  bool fits(const Point& p) const {
    return by_error() ? p.error.value <= *question_.error : p.ms.value <= *question_.ms;
  }
  double rank(const Point& p) const { return by_error() ? p.ms.value : p.error.value; }
  const std::string& metric() const { return question_.options.metric; }
  std::string error_text(double v) const { return number(v) + metric_unit(metric()); }
  std::string label(size_t i) const { return names_.label(*group_.points[i].result); }

  std::string where() const {
    return fmt::format("{}, {} occlusion, {}", group_.scene, group_.visibility == "none" ? "without" : "with",
                       report_.device.name);
  }

  std::string asked() const {
    return by_error() ? fmt::format("{} at most {}", metric_title(metric()), error_text(*question_.error))
                      : fmt::format("at most {} ms", number(*question_.ms));
  }

  std::string sentence() const {
    if (fitting_.empty()) return fmt::format("{}: no case has {}; {}", where(), asked(), nearest());
    const Point& best = group_.points[fitting_.front()];
    std::string out =
        fmt::format("{}: for {}, take {}: {} {} in {} ms ({}){}.", where(), asked(), label(fitting_.front()),
                    metric_title(metric()), with_interval(best.error, metric_unit(metric())), time_text(best),
                    time_words(question_.options.time), rivals());
    return out + " " + halving(best);
  }

  // Where nothing was asked: the least error, and what half of that exactness costs.
  std::string summary() const {
    const std::vector<size_t> front = front_of(group_);
    const Point& least = group_.points[front.back()];
    std::string out = fmt::format("{}: the least {} is {} by {}, in {} ms ({}).", where(),
                                  metric_title(metric()), with_interval(least.error, metric_unit(metric())),
                                  label(front.back()), time_text(least), time_words(question_.options.time));
    const auto is_near = [&](size_t i) { return group_.points[i].error.value <= 2 * least.error.value; };
    const size_t cheapest = *std::ranges::find_if(front, is_near);
    if (cheapest == front.back()) return out + " No cheaper case is within twice that error.";
    const Point& p = group_.points[cheapest];
    return out +
           fmt::format(" Within twice that error {} is the cheapest: {} in {} ms, {:.2g} times as long.",
                       label(cheapest), error_text(p.error.value), number(p.ms.value),
                       p.ms.value / least.ms.value);
  }

  std::string nearest() const {
    const auto closest = std::ranges::min_element(
        group_.points, {}, [&](const Point& p) { return by_error() ? p.error.value : p.ms.value; });
    return fmt::format("the nearest is {} with {} in {} ms.", names_.label(*closest->result),
                       error_text(closest->error.value), number(closest->ms.value));
  }

  // Other methods' points that can't be told from the best in what is asked.
  std::string rivals() const {
    std::vector<std::string> out;
    std::set<std::string> methods = {group_.points[fitting_.front()].result->method};
    const Point& best = group_.points[fitting_.front()];
    for (const size_t i : fitting_) {
      const Point& p = group_.points[i];
      const Relation r = by_error() ? compare_costs(p, best, group_.noise) : compare_errors(p, best);
      if (r == Relation::worse || !methods.insert(p.result->method).second) continue;
      out.push_back(label(i));
    }
    if (out.empty()) return "";
    return fmt::format("; not to be told apart: {}", fmt::join(out, ", "));
  }

  std::string halving(const Point& best) const {
    const double half = 0.5 * best.error.value;
    const auto ms = time_to_reach(group_, front_of(group_), half);
    if (ms) {
      return fmt::format("Halving that error, to {}, takes {} ms, {:.2g} times as long.", error_text(half),
                         number(*ms), *ms / best.ms.value);
    }
    const size_t last = front_of(group_).back();
    const Point& least = group_.points[last];
    return fmt::format("Half that error, {}, is reached by no case measured; the least is {} by {} in {} ms.",
                       error_text(half), error_text(least.error.value), label(last), number(least.ms.value));
  }

  // Each method's best, and how much more it costs than the first.
  std::string table() const {
    std::string out;
    size_t width = 6;
    std::vector<size_t> rows;
    std::set<std::string> methods;
    for (const size_t i : fitting_) {
      if (!methods.insert(group_.points[i].result->method).second) continue;
      rows.push_back(i);
      width = std::max(width, label(i).size());
    }
    out += fmt::format("  {:<{}}  {:>24}  {:>24}  {:>8}\n", "method", width,
                       metric_title(metric()) + metric_unit(metric()) + " [95 %]", "ms [95 %]",
                       by_error() ? "× time" : "× error");
    const double first = rank(group_.points[rows.front()]);
    for (const size_t i : rows) {
      const Point& p = group_.points[i];
      out += fmt::format("  {:<{}}  {:>24}  {:>24}  {:>8}\n", label(i), width, with_interval(p.error, ""),
                         time_text(p), first > 0 ? fmt::format("{:.2f}", rank(p) / first) : "-");
    }
    if (!names_.shared().empty()) out += fmt::format("  all: {}\n", names_.shared());
    out += group_.noise_known
               ? fmt::format("  times differ by up to {} where nothing does (A/A)\n", percent(group_.noise))
               : "  the noise of times is not known: the report has no A/A pair for them\n";
    return out;
  }

  const Report& report_;
  const Question& question_;
  const PointGroup& group_;
  CaseNames names_;
  std::vector<size_t> fitting_;  // best first
};

// One group a scene: the full visibility where there is one, or what is asked.
std::vector<const PointGroup*> groups_asked(const std::vector<PointGroup>& groups, const Question& question) {
  std::vector<const PointGroup*> out;
  std::set<std::string> scenes;
  for (const PointGroup& g : groups) scenes.insert(g.scene);
  if (!question.scene.empty() && !scenes.contains(question.scene)) {
    throw fail(ErrorKind::usage, "the report has no scene '{}' with errors and times; did you mean '{}'?",
               question.scene, nearest_name(question.scene, {scenes.begin(), scenes.end()}));
  }
  for (const std::string& scene : scenes) {
    if (!question.scene.empty() && scene != question.scene) continue;
    const PointGroup* chosen = nullptr;
    for (const PointGroup& g : groups) {
      if (g.scene != scene || (!question.visibility.empty() && g.visibility != question.visibility)) continue;
      if (!chosen || (g.visibility == "full" && chosen->visibility != "full")) chosen = &g;
    }
    if (!chosen)
      throw fail(ErrorKind::usage, "{}: no case was measured with visibility {}", scene, question.visibility);
    out.push_back(chosen);
  }
  return out;
}

}  // namespace

void ask_error(const std::string& text, Question* question) {
  const size_t at = text.find("<=");
  std::string metric = text.substr(0, at == std::string::npos ? 0 : at);
  while (!metric.empty() && metric.back() == ' ') metric.pop_back();
  if (at == std::string::npos || metric.empty())
    throw fail(ErrorKind::usage, "'{}' is no bound; give one like smape<=5", text);
  metric_title(metric);  // throws for one that is not there
  question->options.metric = metric;
  std::string bound = text.substr(at + 2);
  if (!bound.empty() && bound.back() == '%') bound.pop_back();
  question->error = number_in(bound, text, "smape<=5");
}

void ask_time(const std::string& text, Question* question) {
  std::string bound = text;
  if (bound.ends_with("ms")) bound.resize(bound.size() - 2);
  question->ms = number_in(bound, text, "2ms");
}

std::string reply(const Report& report, const Question& question) {
  const std::vector<PointGroup> groups = point_groups(report, question.options);
  if (groups.empty())
    throw fail(ErrorKind::usage,
               "no case of this report has both {} and a time; run a config that measures frames",
               metric_title(question.options.metric));
  std::string out;
  for (const PointGroup* group : groups_asked(groups, question)) {
    if (!out.empty()) out += "\n";
    out += Answer(report, question, *group).text();
  }
  return out;
}

}  // namespace vsglbench
