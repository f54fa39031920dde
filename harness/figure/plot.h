// Line plots as SVG files: curves or points over two axes, either of them logarithmic, with a legend.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace vsglbench {

struct PlotAxis {
  std::string label;  // with its unit, "shade time / ms"
  bool log = false;
  bool from_zero = false;  // linear only: the axis begins, or ends, at 0
};

enum class CurveStyle { line, points, line_and_points };

struct Curve {
  std::string name;                // in the legend
  std::vector<glm::dvec2> points;  // in drawing order
  CurveStyle style = CurveStyle::line;
  bool published = false;  // as a paper has it: black and dashed, with open points
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<Curve> curves;
  std::vector<std::string> notes;      // below the plot, a line each
  uint32_t width = 640, height = 360;  // of the plot area, in pixels; labels and legend come on top
};

// A whole SVG document. Throws Error(case_failed), naming the curve, for one that is empty, a coordinate that
// is NaN or infinite, or one that a logarithmic axis can't show.
std::string to_svg(const Plot& plot);

}  // namespace vsglbench
