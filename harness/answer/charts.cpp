#include "answer/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "answer/front.h"
#include "answer/series.h"
#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// Harmless in a file's name on any system; a view's colon as in the names of images.
std::string file_part(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || c == '.' || c == '@';
    out += c == ':' ? '@' : plain ? c : '_';
  }
  return out;
}

std::vector<PointGroup> chosen_groups(const Report& report, const ChartsOrder& order) {
  std::vector<PointGroup> groups = point_groups(report, order.options);
  if (groups.empty())
    throw fail(ErrorKind::usage, "nothing to draw: no case of this report has both {} and the time '{}'",
               metric_title(order.options.metric), order.options.time);
  if (order.scene.empty()) return groups;
  std::vector<std::string> scenes;
  for (const PointGroup& g : groups) scenes.push_back(g.scene);
  std::erase_if(groups, [&](const PointGroup& g) { return g.scene != order.scene; });
  if (groups.empty())
    throw fail(ErrorKind::usage, "the report has no scene '{}' with errors and times; did you mean '{}'?",
               order.scene, nearest_name(order.scene, scenes));
  return groups;
}

// The front's, or those that a glob matches, by time.
std::vector<size_t> chosen_points(const PointGroup& group, const std::vector<std::string>& globs) {
  if (globs.empty()) return front_of(group);
  std::vector<size_t> out;
  for (size_t i = 0; i < group.points.size(); ++i) {
    const auto matches = [&](const std::string& glob) {
      return matches_glob(group.points[i].result->id, glob);
    };
    if (std::ranges::any_of(globs, matches)) out.push_back(i);
  }
  return out;
}

// "colonnade@cut-full", and with a number where two references have the same name.
std::string stem_of(const PointGroup& group, std::set<std::string>* taken) {
  const std::string plain = file_part(group.scene) + "-" + group.visibility;
  std::string stem = plain;
  for (int k = 2; !taken->insert(stem).second; ++k) stem = fmt::format("{}-{}", plain, k);
  return stem;
}

}  // namespace

std::vector<Chart> charts_of(const ChartSource& source, const std::vector<size_t>& points,
                             std::vector<std::string>* remarks) {
  std::vector<Chart> out = {front_chart(source)};
  if (points.empty()) {
    remarks->push_back(fmt::format("{}: no case matches, hence no passes and no budget", source.subject()));
  } else {
    if (auto passes = passes_chart(source, points))
      out.push_back(std::move(*passes));
    else
      remarks->push_back(fmt::format("{}: the time '{}' is no sum of passes, hence no chart of them",
                                     source.subject(), source.options.time));
    std::vector<std::string> missing;
    if (auto budget = budget_chart(source, points, &missing))
      out.push_back(std::move(*budget));
    else
      remarks->push_back(
          fmt::format("{}: no part of an error can be told from the others, hence no budget; it needs {}",
                      source.subject(), fmt::join(missing, "; ")));
  }
  for (const std::string& key : varied_keys(source.group)) {
    if (auto series = series_chart(source, key)) out.push_back(std::move(*series));
  }
  return out;
}

DrawnCharts draw_charts(const Report& report, const ChartsOrder& order) {
  const std::vector<PointGroup> groups = chosen_groups(report, order);
  const auto some = [&](const PointGroup& g) { return !chosen_points(g, order.cases).empty(); };
  if (std::ranges::none_of(groups, some))
    throw fail(ErrorKind::usage, "no case with error and time matches '{}'",
               fmt::join(order.cases, "' or '"));
  const Gnuplot gnuplot;
  ensure_writable_directory(order.out);
  DrawnCharts drawn;
  std::set<std::string> taken;
  for (const PointGroup& group : groups) {
    const std::string stem = stem_of(group, &taken);
    const ChartSource source(report, group, order.options);
    for (const Chart& chart : charts_of(source, chosen_points(group, order.cases), &drawn.remarks)) {
      for (const PlotFormat format : {PlotFormat::svg, PlotFormat::png}) {
        const fs::path path = order.out / fmt::format("{}-{}-{}.{}", stem, chart.kind, order.options.metric,
                                                      format == PlotFormat::svg ? "svg" : "png");
        write_text(path, gnuplot.run(chart_script(chart, format)));
        drawn.paths.push_back(path);
      }
    }
  }
  return drawn;
}

}  // namespace vsglbench
