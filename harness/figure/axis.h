// A logarithmic axis of gnuplot's.
#pragma once

#include <string>

namespace vsglbench {

struct LogAxis {
  double least = 1, most = 1;  // of the axis: the values' range and a margin
  std::string commands;        // logscale, range and ticks: whole decades, or 1, 2, 5 where they are few
};

// `name`: 'x' or 'y'. The values are above 0, least <= most.
LogAxis log_axis(char name, double least, double most);

}  // namespace vsglbench
