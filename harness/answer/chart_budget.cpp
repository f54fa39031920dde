// Error budgets of chosen points: a waterfall each.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "answer/budget.h"
#include "answer/chart_rows.h"

namespace vsglbench {
namespace {

constexpr size_t kMostBudgets = 6;
constexpr const char* kWhole = "#999999";

// The parts of a budget, as budget.h names them, in its order.
const std::vector<std::string>& part_names() {
  static const std::vector<std::string> names = {"RSM resolution", "SG lobes", "clustering",
                                                 "visibility test", "shadow maps"};
  return names;
}

struct Rows {
  std::vector<std::string> names;
  std::map<std::string, std::vector<ChartBar>> bars;  // by part, and "the case" as a whole
  std::vector<std::string> labels;                    // commands
  std::vector<std::string> missing;                   // what would have to be run, once each
  double least = 0, most = 0;
};

void add_label(Rows* rows, const std::string& text, double x, size_t row) {
  rows->labels.push_back(fmt::format("set label {} at {:.9g}, {} left offset 0.8, 0 font small noenhanced\n",
                                     Gnuplot::quoted(text), x, row));
}

// What was not run is in the next part that was; its name says so.
void add_parts(const ChartSource& source, const Budget& budget, Rows* rows) {
  double from = 0;
  std::vector<std::string> not_run;
  for (const BudgetPart& part : budget.parts) {
    if (!part.error) {
      not_run.push_back(part.name);
      if (std::ranges::count(rows->missing, part.missing) == 0) rows->missing.push_back(part.missing);
      continue;
    }
    not_run.push_back(part.name);
    const double to = part.error->value;
    const size_t row = rows->names.size();
    rows->names.push_back(fmt::format("{}", fmt::join(not_run, " + ")));
    if (part.increment) {
      rows->bars[part.name].push_back({row, from, to});
      add_label(rows, fmt::format("{:+.3g}", *part.increment), std::max(from, to), row);
    } else {
      add_label(rows, fmt::format("{}, can't be told apart", source.error_text(to)), 0, row);
    }
    rows->most = std::max(rows->most, to);
    from = to;
    not_run.clear();
  }
  if (!not_run.empty()) {
    add_label(rows, "not run", from, rows->names.size());
    rows->names.push_back(fmt::format("{}", fmt::join(not_run, " + ")));
  }
}

void add_budget(const ChartSource& source, size_t point, Rows* rows) {
  const Point& p = source.group.points[point];
  if (!rows->names.empty()) rows->names.push_back("");
  const size_t row = rows->names.size();
  rows->names.push_back(source.label(point));
  rows->bars["the case"].push_back({row, 0, p.error.value});
  add_label(rows, source.error_text(p.error.value), p.error.value, row);
  rows->most = std::max(rows->most, p.error.value);
  add_parts(source, error_budget(source.report, *p.result, source.options), rows);
}

}  // namespace

std::optional<Chart> budget_chart(const ChartSource& source, const std::vector<size_t>& points,
                                  std::vector<std::string>* missing) {
  const std::vector<size_t> chosen = evenly(points, kMostBudgets);
  Rows rows;
  for (const size_t i : chosen) add_budget(source, i, &rows);
  *missing = rows.missing;
  const auto is_part = [](const auto& bar) { return bar.first != "the case"; };
  if (std::ranges::none_of(rows.bars, is_part)) return std::nullopt;
  Chart c;
  c.kind = "budget";
  c.title = fmt::format("{}: where {} comes from", source.subject(), metric_title(source.options.metric));
  c.subtitle = fmt::format("{}; from the reference to the case, one approximation more each",
                           source.report.device.name);
  c.right = 240;
  c.notes = {
      "a part is what the metric rises by when this approximation joins those above it, and may be below 0: "
      "errors "
      "of metrics do not add up in general"};
  if (!rows.missing.empty())
    c.notes.push_back(fmt::format("not in the report, so that parts joined by a + can't be told apart: {}",
                                  fmt::join(rows.missing, "; ")));
  if (chosen.size() < points.size())
    c.notes.push_back(fmt::format("{} of {} cases, evenly by time", chosen.size(), points.size()));
  if (!source.shared().empty()) c.notes.push_back(source.shared());
  c.commands = name_rows(&c, rows.names) + fmt::format("set xrange [0:{:.9g}]\nset xlabel {} noenhanced\n",
                                                       rows.most > 0 ? 1.15 * rows.most : 1,
                                                       Gnuplot::quoted(source.error_label()));
  for (const std::string& label : rows.labels) c.commands += label;
  std::vector<std::string> curves;
  const auto draw = [&](const std::string& name, const std::string& colour) {
    if (rows.bars[name].empty()) return;
    const std::string block = fmt::format("part{}", curves.size());
    c.commands += bar_block(block, rows.bars[name]);
    curves.push_back(bar_curve(block, colour, name));
  };
  draw("the case", kWhole);
  for (size_t k = 0; k < part_names().size(); ++k) draw(part_names()[k], colour_of(k));
  c.commands += fmt::format("plot {}\n", fmt::join(curves, ", \\\n     "));
  return c;
}

}  // namespace vsglbench
