// The passes of chosen points, stacked.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "answer/chart_rows.h"

namespace vsglbench {
namespace {

constexpr size_t kMostRows = 30, kMostPasses = 7;  // the other passes are one
constexpr const char* kOthers = "#999999";
// The last one in place of black, in which the sums are drawn.
constexpr size_t kBlack = 6;
constexpr const char* kYellow = "#f0e442";

bool counts(const PassId& pass, const std::string& time) {
  if (time == "frame") return true;
  if (time == "method") return pass.stage != PassStage::draw;
  if (time == "visibility" || pass.stage != PassStage::generate) return false;
  if (time == "generate") return true;
  return pass.half == (time == "generate.rsm" ? Half::rsm : Half::gbuffer);
}

// Passes in the order of a frame, by name, with the sum of their medians over the points.
struct PassWeights {
  std::vector<std::string> names;
  std::map<std::string, double> ms;
};

PassWeights weights_of(const ChartSource& source, const std::vector<size_t>& points) {
  PassWeights out;
  for (const size_t i : points) {
    for (const PassTiming& p : source.group.points[i].result->passes) {
      if (!counts(p.pass, source.options.time)) continue;
      if (out.ms.try_emplace(p.pass.name(), 0).second) out.names.push_back(p.pass.name());
      out.ms[p.pass.name()] += p.ms.median;
    }
  }
  return out;
}

// The heaviest, in the order of a frame.
std::vector<std::string> named_passes(const PassWeights& weights) {
  std::vector<std::string> heavy = weights.names;
  std::ranges::stable_sort(heavy,
                           [&](const auto& a, const auto& b) { return weights.ms.at(a) > weights.ms.at(b); });
  heavy.resize(std::min(heavy.size(), kMostPasses));
  std::vector<std::string> out;
  for (const auto& name : weights.names) {
    if (std::ranges::count(heavy, name) > 0) out.push_back(name);
  }
  return out;
}

// Bars of each named pass, and last of all others, end to end.
std::vector<std::vector<ChartBar>> stacked(const ChartSource& source, const std::vector<size_t>& rows,
                                           const std::vector<std::string>& named) {
  std::vector<std::vector<ChartBar>> out(named.size() + 1);
  for (size_t row = 0; row < rows.size(); ++row) {
    std::vector<double> ms(named.size() + 1, 0);
    for (const PassTiming& p : source.group.points[rows[row]].result->passes) {
      if (!counts(p.pass, source.options.time)) continue;
      const auto at = std::ranges::find(named, p.pass.name());
      ms[static_cast<size_t>(at - named.begin())] += p.ms.median;
    }
    double from = 0;
    for (size_t k = 0; k < ms.size(); ++k) {
      if (ms[k] > 0) out[k].push_back({row, from, from + ms[k]});
      from += ms[k];
    }
  }
  return out;
}

// The sum with its interval, and its number.
std::string sums(const ChartSource& source, const std::vector<size_t>& rows, double widest) {
  std::string out = "$sums << END\n", labels;
  for (size_t row = 0; row < rows.size(); ++row) {
    const Point& p = source.group.points[rows[row]];
    out += fmt::format("{:.9g} {} {:.9g} {:.9g}\n", p.ms.value, row, p.ms.ci95.lo, p.ms.ci95.hi);
    labels += fmt::format("set label '{}, {}' at {:.9g}, {} left font small noenhanced\n",
                          ms_text(p.ms.value), source.error_text(p.error.value),
                          std::max(p.ms.ci95.hi, p.ms.value) + 0.015 * widest, row);
  }
  return out + "END\n" + labels;
}

}  // namespace

std::optional<Chart> passes_chart(const ChartSource& source, const std::vector<size_t>& points) {
  const std::vector<size_t> rows = evenly(points, kMostRows);
  const PassWeights weights = weights_of(source, rows);
  if (weights.names.empty()) return std::nullopt;
  const std::vector<std::string> named = named_passes(weights);
  Chart c;
  c.kind = "passes";
  c.title = fmt::format("{}: what the passes cost", source.subject());
  c.subtitle = source.circumstances();
  c.right = 330;
  c.notes = {
      "bars: medians of the passes, stacked; mark: median of their sum in a frame, with its 95 % interval; "
      "beside it its " +
      metric_title(source.options.metric)};
  if (rows.size() < points.size())
    c.notes.push_back(fmt::format("{} of {} cases, evenly by time", rows.size(), points.size()));
  if (!source.shared().empty()) c.notes.push_back(source.shared());
  std::vector<std::string> names;
  double widest = 0;
  for (const size_t i : rows) {
    names.push_back(source.label(i));
    widest = std::max({widest, source.group.points[i].ms.value, source.group.points[i].ms.ci95.hi});
  }
  c.commands = name_rows(&c, names) +
               fmt::format("set xrange [0:{:.9g}]\nset xlabel {} noenhanced\n", 1.28 * widest,
                           Gnuplot::quoted(source.time_label())) +
               sums(source, rows, widest);
  std::vector<std::string> curves;
  const auto bars = stacked(source, rows, named);
  for (size_t k = 0; k < bars.size(); ++k) {
    if (bars[k].empty()) continue;
    const std::string block = fmt::format("pass{}", k);
    const bool others = k == named.size();
    c.commands += bar_block(block, bars[k]);
    curves.push_back(
        bar_curve(block,
                  others        ? kOthers
                  : k == kBlack ? kYellow
                                : colour_of(k),
                  others ? fmt::format("{} other passes", weights.names.size() - named.size()) : named[k]));
  }
  curves.push_back(
      "$sums using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0.5 lw 1.5 lc rgb 'black' title 'sum'");
  c.commands += fmt::format("plot {}\n", fmt::join(curves, ", \\\n     "));
  return c;
}

}  // namespace vsglbench
