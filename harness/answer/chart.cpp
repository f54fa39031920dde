#include "answer/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "image/font.h"

namespace vsglbench {
namespace {

// Okabe and Ito's palette without its yellow, which is faint on white; kinds of points tell apart what shares
// a colour, and 7 and 12 have no common divisor.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000"};
constexpr int kPoints[] = {7, 5, 9, 11, 13, 15, 6, 4, 8, 10, 12, 14};

constexpr double kTitle = 20, kText = 15, kLine = 20;  // pixels
constexpr double kAbove = 84, kBelow = 74;             // of the plot: title, and the axis' label

std::vector<const CaseResult*> cases_of(const PointGroup& group) {
  std::vector<const CaseResult*> out;
  for (const Point& p : group.points) out.push_back(p.result);
  return out;
}

std::vector<std::string> wrapped_notes(const Chart& chart) {
  const Font font(kText);
  std::vector<std::string> lines;
  for (const std::string& note : chart.notes) {
    for (std::string& line : font.wrap(note, chart.width - 40.0)) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

ChartSource::ChartSource(const Report& r, const PointGroup& g, const AnswerOptions& o)
    : report(r), group(g), options(o), names_(cases_of(g)) {
  for (const CaseResult& c : r.cases) places_.try_emplace(c.method, places_.size());
}

std::string ChartSource::label_without(size_t point, const std::string& key) const {
  return names_.label_without(*group.points[point].result, key == "visibility" ? "vis" : key);
}

std::string ChartSource::error_label() const {
  const std::string title = metric_title(options.metric), unit = metric_unit(options.metric);
  if (options.metric == "rmse") return title + " / (W/m²/sr)";
  return title + (unit.empty() ? "" : " /" + unit);
}

std::string ChartSource::time_label() const { return options.time + " time / ms"; }

std::string ChartSource::subject() const {
  return fmt::format("{}, {} occlusion", group.scene, group.visibility == "none" ? "without" : "with");
}

std::string ChartSource::circumstances() const {
  return fmt::format("{}{}; {} time: {}", report.device.name,
                     report.device.type == "cpu" ? " (a CPU: not to be compared with a GPU)" : "",
                     options.time, time_words(options.time));
}

std::string ChartSource::shared() const {
  return names_.shared().empty() ? "" : "every case: " + names_.shared();
}

std::string ChartSource::error_text(double v) const {
  return significant(v, 3) + metric_unit(options.metric);
}

PlotPlace plot_place(const Chart& chart) {
  const double notes = kLine * static_cast<double>(wrapped_notes(chart).size());
  return {chart.left, chart.width - chart.right, kAbove, chart.height - kBelow - notes - 8};
}

std::string page_label(const Chart& chart, const std::string& text, double x, double y, bool small) {
  return fmt::format("set label {} at screen {:.6f}, screen {:.6f} left noenhanced{}\n",
                     Gnuplot::quoted(text), x / chart.width, 1 - y / chart.height,
                     small ? " font small" : "");
}

std::string chart_script(const Chart& chart, PlotFormat format) {
  const bool svg = format == PlotFormat::svg;
  const PlotPlace at = plot_place(chart);
  std::string out = fmt::format(
      "set terminal {} size {},{} enhanced font 'DejaVu Sans,{}' background rgb 'white'\n"
      "small = 'DejaVu Sans,{}'\nset encoding utf8\n",
      svg ? "svg" : "pngcairo", chart.width, chart.height, svg ? 15 : 11, svg ? 13 : 9.6);
  out += fmt::format(
      "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
      "set tmargin at screen {:.6f}\nset bmargin at screen {:.6f}\n",
      at.left / chart.width, at.right / chart.width, 1 - at.top / chart.height, 1 - at.bottom / chart.height);
  out += "set grid lt 1 lc rgb '#dddddd' lw 1\nset border 3 lc rgb '#555555'\nset tics nomirror\n";
  out += fmt::format(
      "set key at screen {:.6f}, screen {:.6f} left top vertical Left reverse noenhanced samplen 2 spacing "
      "1.15 "
      "font small\n",
      (at.right + 18) / chart.width, 1 - at.top / chart.height);
  const Font title(kTitle), text(kText);
  out += fmt::format("set label {} at screen {:.6f}, screen {:.6f} left noenhanced font 'DejaVu Sans,{}'\n",
                     Gnuplot::quoted(title.fit(chart.title, chart.width - 40.0)), 20.0 / chart.width,
                     1 - 24.0 / chart.height, svg ? 20 : 14.7);
  out += page_label(chart, text.fit(chart.subtitle, chart.width - 40.0), 20, 52, false);
  const auto notes = wrapped_notes(chart);
  for (size_t i = 0; i < notes.size(); ++i)
    out += page_label(chart, notes[i], 20, at.bottom + kBelow + kLine * static_cast<double>(i), false);
  return out + chart.commands;
}

void make_room(Chart* chart, const std::vector<std::string>& texts, double beside) {
  constexpr double kLeast = 300, kMost = 640;
  const Font font(13);
  double widest = 0;
  for (const std::string& text : texts) widest = std::max(widest, font.width(text));
  const double plot = chart->width - chart->right;
  chart->right = std::clamp(1.06 * widest + beside, kLeast, kMost);
  chart->width = static_cast<uint32_t>(plot + chart->right);
}

std::string ms_text(double ms) { return significant(ms, 3) + " ms"; }

std::string colour_of(size_t i) { return kColours[i % std::size(kColours)]; }

std::string point_style(size_t i) { return point_style(i, 0); }

std::string point_style(size_t i, size_t k) {
  return fmt::format("pointtype {} lc rgb '{}'", kPoints[(i + k) % std::size(kPoints)], colour_of(i));
}

std::vector<size_t> evenly(const std::vector<size_t>& list, size_t most) {
  if (list.size() <= most) return list;
  std::vector<size_t> out;
  for (size_t k = 0; k < most; ++k) out.push_back(list[k * (list.size() - 1) / (most - 1)]);
  return out;
}

LogErrors log_errors(const PointGroup& group, const std::vector<size_t>& points) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  LogErrors out{kNone, 0, 0, 0, 0};
  double least = kNone;
  for (const size_t i : points) {
    const Estimate& e = group.points[i].error;
    if (!(e.value > 0)) {
      ++out.zero;
      continue;
    }
    least = std::min(least, e.value);
    if (e.ci95.lo > 0) out.least = std::min(out.least, e.ci95.lo);
    out.most = std::max({out.most, e.value, e.ci95.hi});
  }
  if (least == kNone) return {1, 1, out.zero, 0, 0};
  out.least = std::max(std::min(out.least, least), least / 4);
  for (const size_t i : points) {
    const Point& p = group.points[i];
    if (p.error.value > 0 && p.error.ci95.lo < out.least) ++out.cut;
    if (p.heavy_tailed) ++out.heavy;
  }
  return out;
}

std::vector<std::string> error_notes(const LogErrors& errors) {
  std::vector<std::string> out;
  if (errors.zero > 0)
    out.push_back(
        fmt::format("▽ at the lower edge: cases with an error of 0, which a logarithmic axis can't show: {}",
                    errors.zero));
  if (errors.cut > 0)
    out.push_back(
        fmt::format("intervals that reach below the axis, or to 0, and are cut there: {}", errors.cut));
  if (errors.heavy > 0)
    out.push_back(fmt::format(
        "cases with heavy-tailed seeds, drawn as their median, from the least seed to the largest: {}",
        errors.heavy));
  return out;
}

namespace {

bool shows_floor(const ChartSource& source, const LogAxis& y) {
  return source.group.error_floor > y.least && source.group.error_floor < y.most;
}

}  // namespace

std::string floor_line(const ChartSource& source, const LogAxis& y) {
  if (!shows_floor(source, y)) return "";
  return fmt::format(
      "set arrow from graph 0, first {0:.9g} to graph 1, first {0:.9g} nohead dashtype (8,6) lc rgb "
      "'#777777'\n"
      "set label \"reference's noise\" at graph 1, first {0:.9g} right offset 0, 0.5 font small tc rgb "
      "'#555555'\n",
      source.group.error_floor);
}

std::string floor_note(const ChartSource& source, const LogAxis& y) {
  if (source.group.error_floor <= 0 || shows_floor(source, y)) return "";
  return fmt::format("noise of the reference, which an exact image would show: {}, outside of the axis",
                     source.error_text(source.group.error_floor));
}

}  // namespace vsglbench
