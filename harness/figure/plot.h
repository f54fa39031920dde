// Plots of curves or points over two axes, either of them logarithmic, with a legend, drawn by gnuplot.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "figure/gnuplot.h"

namespace vsglbench {

struct PlotAxis {
  std::string label;  // with its unit, "shade time / ms"
  bool log = false;
  bool from_zero = false;  // linear only: the axis begins, or ends, at 0
};

enum class CurveStyle { line, points };

// From the lower to the upper end in x and y; ends that meet have no bar.
struct ErrorBar {
  glm::dvec2 lower, upper;
};

struct Curve {
  std::string name;                // in the legend
  std::vector<glm::dvec2> points;  // in drawing order
  CurveStyle style = CurveStyle::line;
  bool published = false;        // as a paper has it: black, with open points
  std::vector<ErrorBar> errors;  // of points: none, or one a point
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<Curve> curves;
  std::vector<std::string> notes;      // below the plot
  uint32_t width = 960, height = 540;  // of the whole, in pixels
};

enum class PlotFormat { svg, png };

// A whole file. Throws Error(case_failed), naming the curve, for one that is empty, a coordinate that is NaN
// or infinite, or one that a logarithmic axis can't show; Error(output) for what gnuplot refuses.
std::string draw_plot(const Gnuplot& gnuplot, const Plot& plot, PlotFormat format);

// The commands and the data that gnuplot gets. Throws Error(case_failed) as above.
std::string plot_script(const Plot& plot, PlotFormat format);

}  // namespace vsglbench
