#include "answer/reply.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "answer/front.h"
#include "base/error.h"
#include "base/nearest.h"
#include "base/printable.h"
#include "report/case_names.h"
#include "report/noise.h"
#include "report/table_layout.h"

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

std::string number(double v) { return significant(v, 3); }

std::string with_interval(const Estimate& e, const std::string& unit) {
  return fmt::format("{}{} [{}, {}]", number(e.value), unit, number(e.ci95.lo), number(e.ci95.hi));
}

// Where seeds are heavy-tailed, their median and range: no interval of 95 %.
std::string error_interval(const Point& p, const std::string& unit) {
  if (!p.heavy_tailed) return with_interval(p.error, unit);
  return fmt::format("{}{} [{} … {}]", number(p.error.value), unit, number(p.error.ci95.lo),
                     number(p.error.ci95.hi));
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
    if (fitting_.empty()) return;
    tied_ = by_error() ? as_cheap(group_, fitting_) : as_exact(group_, fitting_);
    best_ = choose(fitting_);
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
    if (by_error()) return p.error.value <= *question_.error;
    return !question_.ms || p.ms.value <= *question_.ms;
  }
  double rank(const Point& p) const { return by_error() ? p.ms.value : p.error.value; }
  size_t choose(const std::vector<size_t>& points) const {
    return by_error() ? cheapest_of(group_, points) : most_exact_of(group_, points);
  }
  const std::string& metric() const { return question_.options.metric; }
  std::string error_text(double v) const { return number(v) + metric_unit(metric()); }
  // Where an error is not above what an exact image would show: ", ≤ floor of 9.8 %".
  std::string floor_text(double v) const {
    return v <= group_.error_floor ? fmt::format(" ≤ floor of {}", error_text(group_.error_floor)) : "";
  }
  std::string error_told(double v) const { return error_text(v) + floor_text(v); }
  std::string error_told(const Point& p) const {
    return error_interval(p, metric_unit(metric())) + (p.heavy_tailed ? " (median and range of seeds)" : "") +
           floor_text(p.error.value);
  }
  std::string label(size_t i) const { return printable(names_.label(*group_.points[i].result)); }

  std::string where() const {
    return printable(fmt::format("{}, {} occlusion, {}", group_.scene,
                                 group_.visibility == "none" ? "without" : "with", report_.device.name));
  }

  std::string asked() const {
    return by_error() ? fmt::format("{} at most {}", metric_title(metric()), error_text(*question_.error))
                      : fmt::format("at most {} ms", number(*question_.ms));
  }

  std::string sentence() const {
    if (fitting_.empty()) return fmt::format("{}: no case has {}; {}", where(), asked(), nearest());
    const Point& best = group_.points[best_];
    const std::string out = fmt::format("{}: for {}, take {}: {} {} in {} ms ({}){}.", where(), asked(),
                                        label(best_), metric_title(metric()), error_told(best),
                                        time_text(best), time_words(question_.options.time), rivals());
    return out + " " + halving(best);
  }

  // Where nothing was asked: the least error, and what half of that exactness costs.
  std::string summary() const {
    const size_t named = most_exact_of(group_, fitting_), least = front_of(group_).back();
    return least_error(named, least) + within_twice(named);
  }

  std::string least_error(size_t named, size_t least) const {
    const Point &p = group_.points[named], &l = group_.points[least];
    const std::string &title = metric_title(metric()), words = time_words(question_.options.time);
    if (named == least) {
      return fmt::format("{}: the least {} is {} by {}, in {} ms ({}).", where(), title, error_told(p),
                         label(named), time_text(p), words);
    }
    return fmt::format(
        "{}: for the least {}, take {}: {} in {} ms ({}); {} by {} in {} ms can't be told from that.",
        where(), title, label(named), error_told(p), time_text(p), words, error_told(l), label(least),
        time_text(l));
  }

  std::string within_twice(size_t named) const {
    const Point& p = group_.points[named];
    std::vector<size_t> near;  // by time
    for (const size_t i : fitting_) {
      if (group_.points[i].error.value <= 2 * p.error.value) near.push_back(i);
    }
    if (std::ranges::count(as_cheap(group_, near), named) > 0) {
      return group_.points[near.front()].ms.value == p.ms.value
                 ? " No cheaper case is within twice that error."
                 : " No case that is surely cheaper is within twice that error.";
    }
    const size_t cheapest = cheapest_of(group_, near);
    const Point& c = group_.points[cheapest];
    return fmt::format(" Within twice that error {} is the cheapest: {} in {} ms, {} times as long.",
                       label(cheapest), error_told(c.error.value), number(c.ms.value),
                       significant(c.ms.value / p.ms.value, 2));
  }

  std::string nearest() const {
    const auto closest = std::ranges::min_element(
        group_.points, {}, [&](const Point& p) { return by_error() ? p.error.value : p.ms.value; });
    return fmt::format("the nearest is {} with {} in {} ms.", printable(names_.label(*closest->result)),
                       error_told(closest->error.value), number(closest->ms.value));
  }

  // Other methods' points that can't be told from the first in what is asked, one a method.
  std::string rivals() const {
    std::vector<std::string> out;
    std::set<std::string> methods = {group_.points[best_].result->method};
    for (const size_t i : tied_) {
      if (methods.insert(group_.points[i].result->method).second) out.push_back(label(i));
    }
    if (out.empty()) return "";
    return fmt::format("; in {} not to be told apart: {}", by_error() ? "time" : "error",
                       fmt::join(out, ", "));
  }

  std::string halving(const Point& best) const {
    const double half = 0.5 * best.error.value;
    const std::vector<size_t> front = front_of(group_);
    if (const auto ms = time_to_reach(group_, front, half)) {
      return fmt::format("Halving that error, to {}, takes {} ms, {} times as long ({}).", error_told(half),
                         number(*ms), significant(*ms / best.ms.value, 2), ends(front, half));
    }
    const size_t last = front.back();
    const Point& least = group_.points[last];
    return fmt::format("Half that error, {}, is reached by no case measured; the least is {} by {} in {} ms.",
                       error_text(half), error_told(least.error.value), label(last), number(least.ms.value));
  }

  // What an error is read off between: "between fis N=64, 20 % in 3 ms, and cut N=64, 8 % in 9 ms".
  std::string ends(const std::vector<size_t>& front, double error) const {
    const auto told = [&](size_t i) {
      const Point& p = group_.points[i];
      return fmt::format("{}, {} in {} ms", label(i), error_told(p.error.value), number(p.ms.value));
    };
    const auto [left, right] = *around_error(group_, front, error);
    return left == right ? "by " + told(left) : fmt::format("between {}, and {}", told(left), told(right));
  }

  // The case named, then each other method's by the same rule, best first.
  std::vector<size_t> best_of_methods() const {
    std::map<std::string, std::vector<size_t>> others;
    for (const size_t i : fitting_) others[group_.points[i].result->method].push_back(i);
    others.erase(group_.points[best_].result->method);
    std::vector<size_t> out = {best_};
    for (const auto& [method, points] : others) out.push_back(choose(points));
    std::stable_sort(out.begin() + 1, out.end(),
                     [&](size_t a, size_t b) { return rank(group_.points[a]) < rank(group_.points[b]); });
    return out;
  }

  std::string error_cell(size_t i) const {
    const Point& p = group_.points[i];
    return error_interval(p, "") + (p.error.value <= group_.error_floor ? " ≤ floor" : "");
  }

  // Each method's best, and how much more it costs than the first.
  std::string table() const {
    std::string out;
    size_t width = 6, error_width = 24;
    const std::vector<size_t> rows = best_of_methods();
    for (const size_t i : rows) {
      width = std::max(width, label(i).size());
      error_width = std::max(error_width, display_width(error_cell(i)));
    }
    out += fmt::format("  {:<{}}  {:>{}}  {:>24}  {:>8}\n", "method", width,
                       metric_title(metric()) + metric_unit(metric()) + " [95 %]", error_width, "ms [95 %]",
                       by_error() ? "× time" : "× error");
    const double first = rank(group_.points[best_]);
    for (const size_t i : rows) {
      const Point& p = group_.points[i];
      out += fmt::format("  {:<{}}  {:>{}}  {:>24}  {:>8}\n", label(i), width, error_cell(i), error_width,
                         time_text(p), first > 0 ? fmt::format("{:.2f}", rank(p) / first) : "-");
    }
    if (std::ranges::any_of(rows, [&](size_t i) { return group_.points[i].heavy_tailed; }))
      out += fmt::format(
          "  [ … ]: median and range of seeds, not 95 %, where the largest is over {} times the median\n",
          kHeavyTail);
    if (std::ranges::any_of(rows,
                            [&](size_t i) { return !floor_text(group_.points[i].error.value).empty(); }))
      out += fmt::format("  floor: the reference's own noise, {}\n", error_text(group_.error_floor));
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
  std::vector<size_t> fitting_;  // within what is asked; all where nothing is
  std::vector<size_t> tied_;     // of these, not to be told from the first in what is asked
  size_t best_ = 0;              // that is named
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

std::string why_no_points(const Report& report, const std::string& metric) {
  const auto failed = std::ranges::count(report.cases, Status::failed, &CaseResult::status);
  if (report.cases.empty()) return "the report has no case";
  if (std::ranges::none_of(report.cases, [](const CaseResult& c) { return c.status == Status::ok; })) {
    return fmt::format("no case of this report is ok: {} of {} failed{}; 'vsglbench table' says why", failed,
                       report.cases.size(),
                       static_cast<size_t>(failed) < report.cases.size() ? ", the others were skipped" : "");
  }
  return fmt::format("no case of this report has both {} and a time; run a config that measures frames",
                     metric_title(metric));
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
  if (groups.empty()) throw fail(ErrorKind::usage, "{}", why_no_points(report, question.options.metric));
  std::string out;
  for (const PointGroup* group : groups_asked(groups, question)) {
    if (!out.empty()) out += "\n";
    out += Answer(report, question, *group).text();
  }
  return printable_lines(out);
}

}  // namespace vsglbench
