// Charts of a group's operating points: a page with title, plot, legend and notes, drawn by gnuplot.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answer/point.h"
#include "figure/axis.h"
#include "figure/plot.h"
#include "report/case_names.h"

namespace vsglbench {

// What all charts of a group are drawn from.
class ChartSource {
 public:
  ChartSource(const Report& report, const PointGroup& group, const AnswerOptions& options);

  const Report& report;
  const PointGroup& group;
  const AnswerOptions options;

  size_t place(const std::string& method) const { return places_.at(method); }  // the same on every chart
  std::string label(size_t point) const { return names_.label(*group.points[point].result); }
  std::string label_without(size_t point, const std::string& key) const;
  std::string error_label() const;    // "SMAPE / %"
  std::string time_label() const;     // "method time / ms"
  std::string subject() const;        // "colonnade, without occlusion"
  std::string circumstances() const;  // device, and what the time is
  std::string shared() const;         // what all cases have; empty: nothing
  std::string error_text(double v) const;

 private:
  CaseNames names_;
  std::map<std::string, size_t> places_;  // of methods, in the report's order
};

struct Chart {
  std::string kind;  // of its file's name: "front"
  std::string title, subtitle;
  std::vector<std::string> notes;       // below the plot
  uint32_t width = 1280, height = 720;  // of the page, pixels
  double left = 95, right = 420;        // pixels beside the plot; the legend is on the right
  std::string commands;                 // gnuplot's, in which `small` is the font of labels
};

// The plot's place on the page, pixels from its upper left.
struct PlotPlace {
  double left, right, top, bottom;
};
PlotPlace plot_place(const Chart& chart);

std::string chart_script(const Chart& chart, PlotFormat format);

// (a) error and time of every point with both intervals, and the front.
Chart front_chart(const ChartSource& source);
// (b) the passes of these points; nothing where the time is no sum of passes.
std::optional<Chart> passes_chart(const ChartSource& source, const std::vector<size_t>& points);
// (c) error budgets of these points; nothing where no part of any can be told from the others. `missing`:
// what would have to be run for the parts that can't.
std::optional<Chart> budget_chart(const ChartSource& source, const std::vector<size_t>& points,
                                  std::vector<std::string>* missing);
// (d), (e) error against the values of a key, a curve a method and choice of all else.
std::optional<Chart> series_chart(const ChartSource& source, const std::string& key);

// --- what they share ---

// Colour and kind of point of the i-th method.
std::string point_style(size_t i);
// The k-th choice of settings of the i-th method: its colour, and another kind of point; of k = 0 as above.
std::string point_style(size_t i, size_t k);
std::string colour_of(size_t i);
std::string ms_text(double ms);  // "1.07 ms", "2417 ms"
// At most `most` of a list, evenly, with its first and last.
std::vector<size_t> evenly(const std::vector<size_t>& list, size_t most);
// The page is as much wider as these texts need beside the plot, up to a limit, and `beside` pixels more.
void make_room(Chart* chart, const std::vector<std::string>& texts, double beside);
// A label at a place of the page, pixels from its upper left.
std::string page_label(const Chart& chart, const std::string& text, double x, double y, bool small = true);

// Errors on a logarithmic axis: those that it can show, and how many it can't.
struct LogErrors {
  double least = 1, most = 1;  // what the axis must hold; no lower than a quarter of the least error
  size_t zero = 0;             // errors of 0, which are drawn at the axis' lower end
  size_t cut = 0;              // intervals that reach below `least`
  size_t heavy = 0;            // points that are medians, with the range of seeds
};
LogErrors log_errors(const PointGroup& group, const std::vector<size_t>& points);
// What a reader must know of them.
std::vector<std::string> error_notes(const LogErrors& errors);
// The reference's noise as a line across the plot, or as a note where the axis does not hold it; else empty.
std::string floor_line(const ChartSource& source, const LogAxis& y);
std::string floor_note(const ChartSource& source, const LogAxis& y);

}  // namespace vsglbench
