#include <fmt/format.h>

#include <optional>

#include "base/printable.h"
#include "cli/command.h"
#include "dashboard/page.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct DashboardCommand {
  DashboardOrder order;
  std::string images = "exr";
  fs::path out = "index.html";
  std::optional<fs::path> papers, stability;
};

void make(DashboardCommand command) {
  if (command.out.empty()) throw fail(ErrorKind::usage, "--out: is empty; name the page's file");
  std::error_code ec;
  if (fs::is_directory(command.out, ec))
    throw fail(ErrorKind::usage, "--out {}: is a folder; name a file in it", command.out.string());
  if (!(command.order.pictures.max_mb >= 0))
    throw fail(ErrorKind::usage, "--max-mb {}: is below 0; name the MB that pictures may take, or 0 for none",
               command.order.pictures.max_mb);
  command.order.pictures.mode = picture_mode(command.images);
  for (const auto& [name, path] :
       {std::pair("--papers", command.papers), {"--stability", command.stability}}) {
    if (path && path->empty())
      throw fail(ErrorKind::usage, "{}: is empty; name a file, or leave it out", name);
  }
  command.order.papers = command.papers.value_or("");
  command.order.stability = command.stability.value_or("");
  const Dashboard dashboard = make_dashboard(command.order);
  write_dashboard(dashboard, command.out);
  for (const auto& note : dashboard.digest.at("notes"))
    fmt::print(stderr, "note: {}\n", printable(note.get<std::string>()));
  if (!fs::is_regular_file(command.out, ec)) return;  // a pipe may be where this would be printed
  const auto size = fs::file_size(command.out, ec);
  const size_t pictures = dashboard.pictures.size();
  fmt::print("{}: {:.1f} MB, {} picture{}\n", printable(command.out.string()),
             ec ? 0.0 : static_cast<double>(size) / 1e6, pictures, pictures == 1 ? "" : "s");
}

}  // namespace

void add_dashboard_command(CLI::App& app) {
  auto options = std::make_shared<DashboardCommand>();
  CLI::App* command =
      app.add_subcommand("dashboard", "one page of one report, two, or a history, for a browser");
  command->footer(
      "The page holds all that it shows and opens from a file, without a network: error against time, "
      "passes, "
      "budgets,\nprices of knobs, images, flicker, effects, claims. Two reports are compared, the first "
      "being the "
      "base. Of more,\nthe newest is shown in full and all of its machine as a history. Pictures come from "
      "the "
      "report's folder: the\nfront's cases as half floats, the others as PNG.\n"
      "Example: vsglbench dashboard reports/front-lavapipe --papers reports/papers/lavapipe/papers.json "
      "--out "
      "index.html");
  command->add_option("reports", options->order.reports, "report.json, or its folder; may come again")
      ->required();
  command->add_option("--out", options->out, "the page (default: index.html)");
  command->add_option("--stability", options->stability, "what `stability --json` printed");
  command->add_option("--papers", options->papers, "papers.json, which `reproduce` wrote");
  command->add_option("--images", options->images, "none, png, or exr (default): pictures in the page");
  command
      ->add_option("--case", options->order.pictures.cases,
                   "glob of ids whose pictures have values, beside the front's; may come again")
      ->allow_extra_args(false);
  command->add_option("--metric", options->order.pictures.metric, "whose front that is (default: smape)");
  command->add_option("--max-mb", options->order.pictures.max_mb,
                      "of the page that pictures may take (default: 25)");
  command->callback([=] { make(*options); });
}

}  // namespace vsglbench
