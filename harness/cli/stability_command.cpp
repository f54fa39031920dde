#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "cli/command.h"
#include "stability/stability.h"

namespace vsglbench {
namespace {

void print(const StabilityCell& c) {
  const std::string error = c.status == Stability::left_out ? "" : fmt::format("{:.1e}", c.error);
  fmt::print("{:<8} {:>8}  {:<21} {:<27} {:<16} {}\n", stability_name(c.status), error, c.hard_case, c.method,
             c.diffuse, c.why);
  std::fflush(stdout);
}

std::map<Stability, size_t> counts(const std::vector<StabilityCell>& cells) {
  std::map<Stability, size_t> n;
  for (const StabilityCell& cell : cells) ++n[cell.status];
  return n;
}

Json to_json(const std::vector<StabilityCell>& cells, const std::map<Stability, size_t>& n) {
  Json json = {{"schema", "vsglbench.stability/1"}, {"ok_error", kOkError}, {"bad_error", kBadError}};
  const auto count = [&](Stability s) { return n.contains(s) ? n.at(s) : 0; };
  json["counts"] = {{"ok", count(Stability::ok)},
                    {"bias", count(Stability::bias)},
                    {"bad", count(Stability::bad)},
                    {"left_out", count(Stability::left_out)}};
  json["cells"] = Json::array();
  for (const StabilityCell& cell : cells) json["cells"].push_back(to_json(cell));
  return json;
}

// Whether no cell is bad.
bool run(const StabilityOptions& options, bool json) {
  const auto cells = run_stability(options, [&](const StabilityCell& cell) {
    if (!json) print(cell);
  });
  const auto n = counts(cells);
  const size_t bad = n.contains(Stability::bad) ? n.at(Stability::bad) : 0;
  if (json) {
    fmt::print("{}\n", to_json(cells, n).dump(2));
  } else {
    std::string sum;
    for (const auto& [status, count] : n) sum += fmt::format(", {} {}", count, stability_name(status));
    fmt::print("{} cells{}\n", cells.size(), sum);
  }
  return bad == 0;
}

}  // namespace

void add_stability_command(CLI::App& app, CommandResult* result) {
  auto options = std::make_shared<StabilityOptions>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("stability", "hold lights and pixels of hard cases to double precision");
  command->footer(fmt::format(
      "A line a cell: verdict, worst relative error, case, method, diffuse model, and where that error is.\n"
      "  ok        within {:g} of the same formula in double precision, and nothing impossible\n"
      "  bias      finite and not negative, but off by more, or power beyond the method's flux_bound\n"
      "  bad       NaN, Inf, negative, off by more than {:g}; an error where none is due; a crash\n"
      "  left out  the case means nothing to the method\n"
      "scenes/hard/README.md explains each case.\n"
      "Exit codes: 0 no cell is bad, 1 one is, 2 unknown method, case or kernel, 3 no usable device.\n"
      "Example: vsglbench stability --method mfis --case on-light --case far-half",
      kOkError, kBadError));
  command->add_option("--method", options->methods, "only this one; may come again (default: all)");
  command->add_option("--case", options->cases, "only this one; may come again (default: all)");
  command->add_option("--diffuse", options->diffuse,
                      "only this diffuse model; may come again (default: all)");
  command->add_option("--time-limit", options->silence_s, "seconds that a case may take before it is stopped")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--device", options->device, "index, UUID, PCI address or part of a device's name");
  command->add_flag("--json", *json, "as JSON, once all is done");
  command->callback([=] { result->exit_code = run(*options, *json) ? 0 : 1; });
}

}  // namespace vsglbench
