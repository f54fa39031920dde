#include "figure/plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/error.h"
#include "figure/axis.h"
#include "image/font.h"

namespace vsglbench {
namespace {

// Okabe and Ito's palette, which colour-blind readers can tell apart; dashes and kinds of points do the same
// for print.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr const char* kDashes[] = {"solid", "(18,6)", "(4,4)", "(18,6,4,6)", "(30,6)", "(10,5,3,5,3,5)"};
constexpr int kPoints[] = {7,  5,  9,
                           13, 11, 15};    // disk, square, triangle, diamond, triangle downwards, pentagon
constexpr double kTitle = 20, kNote = 15;  // pixels

std::string quoted(const std::string& text) { return Gnuplot::quoted(text); }

void check_point(const Plot& plot, const Curve& curve, const glm::dvec2& p) {
  const char* what = nullptr;
  if ((plot.x.log && p.x <= 0) || (plot.y.log && p.y <= 0)) what = "which a logarithmic axis can't show";
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) what = "which is not finite";
  if (!what) return;
  throw fail(ErrorKind::case_failed, "plot '{}': curve '{}' has the point ({}, {}), {}", plot.title,
             curve.name, p.x, p.y, what);
}

void check(const Plot& plot) {
  if (plot.curves.empty()) throw fail(ErrorKind::case_failed, "plot '{}' has no curve", plot.title);
  for (const Curve& curve : plot.curves) {
    if (curve.points.empty()) {
      throw fail(ErrorKind::case_failed, "plot '{}': curve '{}' has no points", plot.title, curve.name);
    }
    if (!curve.errors.empty() && curve.errors.size() != curve.points.size())
      throw std::logic_error("error bars of some points only");
    for (const glm::dvec2& p : curve.points) check_point(plot, curve, p);
    for (const ErrorBar& e : curve.errors)
      check_point(plot, curve, e.lower), check_point(plot, curve, e.upper);
  }
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double value) { least = std::min(least, value), most = std::max(most, value); }
};

Range range_of(const Plot& plot, int axis) {
  Range range;
  for (const Curve& curve : plot.curves) {
    for (const glm::dvec2& p : curve.points) range.add(p[axis]);
    for (const ErrorBar& e : curve.errors) range.add(e.lower[axis]), range.add(e.upper[axis]);
  }
  return range;
}

std::string axis_commands(const Plot& plot, int axis) {
  const PlotAxis& a = axis == 0 ? plot.x : plot.y;
  const char name = axis == 0 ? 'x' : 'y';
  const Range range = range_of(plot, axis);
  std::string out = fmt::format("set {}label {} noenhanced\n", name, quoted(a.label));
  if (a.log) return out + log_axis(name, range.least, range.most).commands;
  if (a.from_zero)
    out += fmt::format("set {}range [{}]\n", name,
                       range.least >= 0  ? "0:*"
                       : range.most <= 0 ? "*:0"
                                         : "*:*");
  return out;
}

// A block of data a curve: x, y, and the ends of its bars.
std::string data_blocks(const Plot& plot) {
  std::string out;
  for (size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& c = plot.curves[i];
    out += fmt::format("$curve{} << END\n", i);
    for (size_t k = 0; k < c.points.size(); ++k) {
      const glm::dvec2 &p = c.points[k], &lower = c.errors.empty() ? p : c.errors[k].lower,
                       &upper = c.errors.empty() ? p : c.errors[k].upper;
      out += fmt::format("{} {} {} {} {} {}\n", p.x, p.y, lower.x, upper.x, lower.y, upper.y);
    }
    out += "END\n";
  }
  return out;
}

std::string curve_command(const Curve& c, size_t i) {
  const std::string colour = c.published ? "black" : kColours[i % std::size(kColours)];
  const int point = c.published ? 6 : kPoints[i % std::size(kPoints)];
  const std::string dash = c.published ? "(6,6)" : kDashes[i % std::size(kDashes)];
  const bool bars = !c.errors.empty();
  const std::string style =
      c.style == CurveStyle::line
          ? fmt::format("using 1:2 with lines lw 2 dashtype {}", dash)
          : fmt::format("using {} pointtype {} pointsize 1.4 lw 1.5",
                        bars ? "1:2:3:4:5:6 with xyerrorbars" : "1:2 with points", point);
  return fmt::format("$curve{} {} lc rgb '{}' title {} noenhanced", i, style, colour, quoted(c.name));
}

}  // namespace

std::string plot_script(const Plot& plot, PlotFormat format) {
  check(plot);
  const Font title(kTitle), note(kNote);
  const double width = plot.width - 40.0;
  std::vector<std::string> notes;
  for (const auto& text : plot.notes) {
    for (auto& line : note.wrap(text, width)) notes.push_back(std::move(line));
  }
  std::string out =
      fmt::format("set terminal {} size {},{} enhanced font 'DejaVu Sans,{}' background rgb 'white'\n",
                  format == PlotFormat::svg ? "svg" : "pngcairo", plot.width, plot.height,
                  format == PlotFormat::svg ? 15 : 11);
  out += "set encoding utf8\nset grid lt 1 lc rgb '#dddddd' lw 1\nset border lc rgb '#555555'\n";
  out += "set key outside right top vertical Left reverse noenhanced samplen 3 spacing 1.2\n";
  out += fmt::format("set title {} noenhanced\n", quoted(title.fit(plot.title, width)));
  out += axis_commands(plot, 0) + axis_commands(plot, 1);
  out += fmt::format("set bmargin {}\n", 3.8 + 1.2 * static_cast<double>(notes.size()));
  for (size_t i = 0; i < notes.size(); ++i) {
    out +=
        fmt::format("set label {} at screen 0, screen 0 offset character 2, character {} left noenhanced\n",
                    quoted(notes[i]), 0.7 + 1.2 * static_cast<double>(notes.size() - 1 - i));
  }
  out += data_blocks(plot);
  std::vector<std::string> curves;
  for (size_t i = 0; i < plot.curves.size(); ++i) curves.push_back(curve_command(plot.curves[i], i));
  return out + fmt::format("plot {}\n", fmt::join(curves, ", \\\n     "));
}

std::string draw_plot(const Gnuplot& gnuplot, const Plot& plot, PlotFormat format) {
  return gnuplot.run(plot_script(plot, format));
}

}  // namespace vsglbench
