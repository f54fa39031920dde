#include <fmt/format.h>

#include "answer/claims.h"
#include "cli/command.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct ClaimsCommand {
  fs::path report, list;
  std::vector<std::string> names;
  bool markdown = false;
};

void print(const ClaimsCommand& command) {
  std::vector<PaperClaim> claims = load_claims(command.list);
  if (!command.names.empty()) {
    std::vector<std::string> known;
    for (const PaperClaim& c : claims) known.push_back(c.name);
    for (const std::string& name : command.names) {
      if (std::ranges::count(known, name) == 0)
        throw fail(ErrorKind::usage, "no claim is named '{}'; there are {}", name, fmt::join(known, ", "));
    }
    std::erase_if(claims,
                  [&](const PaperClaim& c) { return std::ranges::count(command.names, c.name) == 0; });
  }
  const Report report = read_report_at(command.report);
  std::vector<TriedClaim> tried;
  for (const PaperClaim& c : claims) tried.push_back(try_claim(report, c));
  fmt::print("{}", claims_text(report, tried, command.markdown));
}

}  // namespace

void add_claims_command(CLI::App& app) {
  auto options = std::make_shared<ClaimsCommand>();
  CLI::App* command =
      app.add_subcommand("claims", "what papers claim of errors and times, tried on a report");
  command->footer(
      "A claim compares two settings in cases that are alike in all else, seed by seed. In each scene it "
      "holds, does "
      "not,\nholds in part (some pairs surely do, others surely don't), is undecided (the intervals don't "
      "tell), or was "
      "not run:\nthe report lacks a side. A claim that does not hold is a finding and no failure.\n"
      "Example: vsglbench claims reports/cut-lavapipe --markdown");
  command->add_option("report", options->report, "report.json, or its folder")->required();
  command->add_option("--claim", options->names, "only the claim of this name; may come again")
      ->allow_extra_args(false);
  command->add_option("--list", options->list,
                      "a list of claims of your own (default: harness/answer/claims.json)");
  command->add_flag("--markdown", options->markdown, "as Markdown");
  command->callback([=] { print(*options); });
}

}  // namespace vsglbench
