#include <fmt/format.h>

#include "answer/analysis.h"
#include "cli/command.h"
#include "report/noise.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct AnalyseCommand {
  fs::path report;
  std::string time = "method";
  bool write = false;
};

void analyse(const AnalyseCommand& command) {
  Report report = read_report_at(command.report);
  report.analysis = analysis_of(report, command.time);
  if (!command.write) {
    fmt::print("{}\n", report.analysis.dump(2));
    return;
  }
  const fs::path file = report_file(command.report);
  write_report(file, report);
  fmt::print("{}: {}\n", file.string(),
             report.analysis.is_null()
                 ? "no case has both an error and this time"
                 : fmt::format("analysis of {} groups", report.analysis.at("groups").size()));
}

}  // namespace

void add_analyse_command(CLI::App& app) {
  auto options = std::make_shared<AnalyseCommand>();
  CLI::App* command = app.add_subcommand(
      "analyse", "what a report's cases show together, as JSON: fronts, prices of settings, error budgets");
  command->footer(
      "Every report that 'run' writes ends with it, over the time 'method'. This makes it for one of old, or "
      "over "
      "another time.\n"
      "Example: vsglbench analyse reports/quick-lavapipe --sum frame\n"
      "         vsglbench analyse reports/quick-lavapipe --write");
  command->add_option("report", options->report, "report.json, or its folder")->required();
  command->add_option("--sum", options->time,
                      fmt::format("which time counts: {} (default method: all passes but the raster of the "
                                  "halves)",
                                  fmt::join(time_columns(), ", ")));
  command->add_flag("--write", options->write, "put it into the report's file, in place of what is there");
  command->callback([=] { analyse(*options); });
}

}  // namespace vsglbench
