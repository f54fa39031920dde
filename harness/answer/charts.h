// `vsglbench plot`: the charts of a report as SVG and PNG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "answer/chart.h"

namespace vsglbench {

struct ChartsOrder {
  std::filesystem::path out;       // folder; is made
  AnswerOptions options;           // metric and time
  std::string scene;               // empty: all
  std::vector<std::string> cases;  // globs: of whom passes and budgets are drawn; empty: of the front
};

struct DrawnCharts {
  std::vector<std::filesystem::path> paths;
  std::vector<std::string> remarks;  // what was not drawn, and why
};

// Of each scene and visibility SCENE-VISIBILITY-front-METRIC, -passes-METRIC, -budget-METRIC, and
// -over-KEY-METRIC of every key that cases differ in, each as .svg and .png; the colon of a view is an @.
// Throws Error(usage) where no case has both error and time, for a scene that is not there and for globs that
// match nothing; Error(output).
DrawnCharts draw_charts(const Report& report, const ChartsOrder& order);

// All charts of a group.
std::vector<Chart> charts_of(const ChartSource& source, const std::vector<size_t>& points,
                             std::vector<std::string>* remarks);

}  // namespace vsglbench
