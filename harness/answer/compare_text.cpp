#include <algorithm>
#include <cmath>

#include "answer/compare.h"
#include "base/printable.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

struct Line {
  double size = 0;  // |log ratio|
  std::string what, change, figures;
};

std::string change_percent(double ratio) { return fmt::format("{:+.1f} %", 100 * (ratio - 1)); }

Line line_of(const TimeChange& t) {
  const std::string what = !t.case_id.empty() ? t.case_id
                           : t.method.empty() ? "pass " + t.time
                                              : "pass " + t.time + " of " + t.method;
  return {std::abs(std::log(t.ratio.value)), printable(what), std::string(name(t.change)),
          fmt::format("{} [{}, {}], noise {}", change_percent(t.ratio.value), change_percent(t.ratio.ci95.lo),
                      change_percent(t.ratio.ci95.hi), t.noise ? percent(*t.noise) : "not known")};
}

Line line_of(const ErrorChange& e) {
  return {std::abs(std::log(e.ratio.value)), printable(e.case_id + ", " + e.metric),
          std::string(name(e.change)),
          fmt::format("{} → {}, {} [{}, {}]", significant(e.base, 4), significant(e.now, 4),
                      change_percent(e.ratio.value), change_percent(e.ratio.ci95.lo),
                      change_percent(e.ratio.ci95.hi))};
}

// Regressions, then improvements, each from the largest; what is the same or unclear is counted only.
template <class T>
void add_lines(const std::vector<T>& changes, std::vector<Line>* worse, std::vector<Line>* better) {
  for (const T& c : changes) {
    if (c.change == Change::same || c.change == Change::ambiguous) continue;
    (is_regression(c.change) ? worse : better)->push_back(line_of(c));
  }
}

template <class T>
std::string counts(const std::vector<T>& changes) {
  std::string out;
  for (const Change c :
       {Change::slower, Change::faster, Change::worse, Change::better, Change::same, Change::ambiguous}) {
    const auto n = std::ranges::count(changes, c, &T::change);
    if (n > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", n, name(c));
  }
  return out.empty() ? "none" : out;
}

// Those that the pass over all cases does not say already.
std::vector<TimeChange> of_methods_alone(const Comparison& c) {
  std::vector<TimeChange> out;
  std::ranges::copy_if(c.method_passes, std::back_inserter(out), [&](const TimeChange& m) {
    return std::ranges::none_of(
        c.passes, [&](const TimeChange& p) { return p.time == m.time && p.change == m.change; });
  });
  return out;
}

void print_lines(std::vector<Line> lines, bool markdown, std::string* out) {
  std::ranges::stable_sort(lines, std::ranges::greater(), &Line::size);
  for (const Line& l : lines) {
    *out += markdown ? fmt::format("| {} | {} | {} |\n", l.change, l.what, l.figures)
                     : fmt::format("{:<7} {}: {}\n", l.change, l.what, l.figures);
  }
}

void print_ids(const char* what, const std::vector<std::string>& ids, std::string* out) {
  if (ids.empty()) return;
  constexpr size_t kShown = 5;
  const size_t shown = std::min(ids.size(), kShown);
  std::vector<std::string> first(ids.begin(), ids.begin() + static_cast<ptrdiff_t>(shown));
  std::ranges::transform(first, first.begin(), printable);
  *out += fmt::format("{}: {}{}\n", what, fmt::join(first, ", "),
                      ids.size() > shown ? fmt::format(" and {} more", ids.size() - shown) : "");
}

}  // namespace

std::string comparison_text(const Comparison& c, bool markdown) {
  if (!c.refusal.empty()) return "not compared: " + printable(c.refusal) + "\n";
  std::vector<Line> worse, better;
  add_lines(c.passes, &worse, &better);
  add_lines(of_methods_alone(c), &worse, &better);
  add_lines(c.times, &worse, &better);
  add_lines(c.errors, &worse, &better);
  std::string out;
  if (markdown && !(worse.empty() && better.empty())) out += "| change | what | figures |\n|---|---|---|\n";
  print_lines(std::move(worse), markdown, &out);
  print_lines(std::move(better), markdown, &out);
  if (markdown && !out.empty()) out += "\n";
  print_ids("no longer ok", c.broken, &out);
  print_ids("ok now", c.mended, &out);
  print_ids("not in the new report", c.missing, &out);
  print_ids("new", c.added, &out);
  out += fmt::format("{} cases; passes over all of them: {}; of one method: {}; times: {}; errors: {}\n",
                     c.cases, counts(c.passes), counts(c.method_passes), counts(c.times), counts(c.errors));
  if (c.byte_equal)
    out += "kernels, plugins and driver are byte for byte those of the base: differences of time are noise\n";
  return printable_lines(out);
}

}  // namespace vsglbench
