#include <fmt/format.h>

#include <algorithm>

#include "answer/reply.h"
#include "answer/rivals.h"
#include "cli/command.h"
#include "report/noise.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct AnswerCommand {
  fs::path report;
  Question question;
  std::string error, time, method, metric;
};

void print(const AnswerCommand& command) {
  Question question = command.question;
  if (!command.error.empty() && !command.time.empty())
    throw fail(ErrorKind::usage, "ask for one of --error smape<=5 and --time 2ms");
  if (!command.method.empty()) {
    if (!command.error.empty() || !command.time.empty())
      throw fail(ErrorKind::usage, "ask for one of --method cut, --error smape<=5 and --time 2ms");
    RivalQuestion rivals{.method = command.method,
                         .time = question.options.time,
                         .scene = question.scene,
                         .visibility = question.visibility};
    if (!command.metric.empty()) rivals.metrics = {command.metric};
    fmt::print("{}", rivalry_table(rivalries(read_report_at(command.report), rivals)));
    return;
  }
  if (!command.metric.empty()) question.options.metric = command.metric;
  if (!command.error.empty()) ask_error(command.error, &question);
  if (!command.time.empty()) ask_time(command.time, &question);
  fmt::print("{}", reply(read_report_at(command.report), question));
}

}  // namespace

void add_answer_command(CLI::App& app) {
  auto options = std::make_shared<AnswerCommand>();
  CLI::App* command =
      app.add_subcommand("answer", "which method and settings reach an error, or are best within a time");
  command->footer(
      "One sentence and a small table a scene: the case that is named, what halving its error costs, and "
      "every "
      "method's own.\n"
      "Which is named: with --error, of the cases that reach it and whose time can't be told from the "
      "cheapest's, the most exact;\n"
      "with --time, of the cases within it whose error can't be told from the least, the cheapest. What lies "
      "within the\nintervals or the A/A noise can't be told. Without either, the same of all cases, and of "
      "those within twice that error.\n"
      "Times are medians, errors means over seeds (medians and ranges where one seed stands far out), with "
      "95 % intervals.\n"
      "\"≤ floor\": not above the noise of the reference itself.\n"
      "What halving costs is read off the front in log-log between the two cases named; nothing is "
      "extrapolated.\n"
      "Example: vsglbench answer reports/front-lavapipe --scene cornell --error 'smape<=10'\n"
      "         vsglbench answer reports/front-lavapipe --time 50ms --metric rmse\n"
      "         vsglbench answer reports/front-lavapipe --method cut");
  command->add_option("report", options->report, "report.json, or its folder")->required();
  command->add_option("--scene", options->question.scene, "one scene (default: all)");
  command->add_option("--error", options->error, "a bound such as smape<=5, rmse<=0.01, flip<=0.1");
  command->add_option("--time", options->time, "a bound such as 2ms");
  command->add_option(
      "--method", options->method,
      "instead: a table of which of this method's points others dominate in RMSE and FLIP, and its "
      "RMSE beside the papers' VSGL methods at equal time");
  command->add_option("--metric", options->metric,
                      "with --time: the error to make small (default smape); with --method: the one that "
                      "counts (default RMSE and FLIP)");
  command->add_option(
      "--sum", options->question.options.time,
      fmt::format("which time counts: {} (default method: all passes but the raster of the halves)",
                  fmt::join(time_columns(), ", ")));
  command
      ->add_option("--visibility", options->question.visibility,
                   "none or full: against which reference (default: full where there is one; with "
                   "--method both)")
      ->check(CLI::IsMember({"none", "full"}));
  command->callback([=] { print(*options); });
}

}  // namespace vsglbench
