// Horizontal bars, a row each from the top, their names on the left.
#pragma once

#include <string>
#include <vector>

#include "answer/chart.h"

namespace vsglbench {

struct ChartBar {
  size_t row = 0;
  double from = 0, to = 0;
};

// Boxes of one colour as a data block and the curve that draws it.
std::string bar_block(const std::string& name, const std::vector<ChartBar>& bars);
std::string bar_curve(const std::string& name, const std::string& colour, const std::string& title);

// Sets the page's height and left margin for these rows, and returns the axis of their names.
std::string name_rows(Chart* chart, const std::vector<std::string>& names);

}  // namespace vsglbench
