#include <fmt/format.h>

#include "answer/charts.h"
#include "base/log.h"
#include "cli/command.h"
#include "report/noise.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct PlotCommand {
  fs::path report;
  ChartsOrder order;
};

void plot(PlotCommand command) {
  if (command.order.out.empty()) command.order.out = report_file(command.report).parent_path() / "plots";
  const DrawnCharts drawn = draw_charts(read_report_at(command.report), command.order);
  for (const fs::path& path : drawn.paths) fmt::print("{}\n", path.string());
  for (const std::string& remark : drawn.remarks) log_info("{}", remark);
}

}  // namespace

void add_plot_command(CLI::App& app) {
  auto options = std::make_shared<PlotCommand>();
  CLI::App* command =
      app.add_subcommand("plot", "charts of a report as SVG and PNG: error, time, passes, budgets");
  command->footer(
      "Of each scene, with and without occlusion, and named SCENE-VISIBILITY-KIND-METRIC:\n"
      "  front     error against time in log-log, both with 95 % intervals, and the front\n"
      "  passes    what the passes of the front's cases cost\n"
      "  budget    where their error comes from\n"
      "  over-KEY  error against N, K, importance lights and whatever else cases differ in\n"
      "Example: vsglbench plot reports/cut-lavapipe --scene cornell --metric rmse --out plots");
  command->add_option("report", options->report, "report.json, or its folder")->required();
  command->add_option("--out", options->order.out, "folder for the files (default plots/ beside the report)");
  command->add_option("--scene", options->order.scene, "one scene (default: all)");
  command->add_option("--metric", options->order.options.metric, "the error (default smape)");
  command->add_option("--sum", options->order.options.time,
                      fmt::format("which time counts: {} (default method: all passes but the raster of the "
                                  "halves)",
                                  fmt::join(time_columns(), ", ")));
  command
      ->add_option(
          "--case", options->order.cases,
          "passes and budgets of the cases whose id matches one of these globs (default: of the front)")
      ->allow_extra_args(false);
  command->callback([=] { plot(*options); });
}

}  // namespace vsglbench
