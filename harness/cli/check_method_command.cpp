#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "base/error.h"
#include "cli/command.h"
#include "conformance/conformance.h"
#include "method/registry.h"

namespace vsglbench {
namespace {

constexpr size_t kMostLines = 5;  // of one check's failures; --json has all

bool is_method(const std::string& name) {
  return std::ranges::any_of(all_methods(), [&](const MethodInfo* m) { return m->name == name; });
}

MethodInfo find(const std::string& name_or_path) {
  std::error_code ec;
  if (std::filesystem::is_directory(name_or_path, ec) && !is_method(name_or_path)) {
    throw fail(ErrorKind::usage, "{}: is a folder; give the plugin that was built from it: {}", name_or_path,
               (std::filesystem::path(name_or_path) / "build" / "plugins" / "NAME.so").string());
  }
  const bool path = name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".so");
  return path ? inspect_plugin(name_or_path) : find_method(name_or_path);
}

void print(const std::string& method, const CheckResult& result) {
  const std::string check = fmt::format("conformance.{}.{}", method, result.name);
  if (result.ok()) {
    fmt::print("ok      {}: {} inputs, {:.1f} s\n", check, result.inputs, result.seconds);
  } else {
    const size_t shown = std::min(result.failures.size(), kMostLines);
    for (size_t i = 0; i < shown; ++i) fmt::print("FAILED  {}: {}\n", check, result.failures[i]);
    if (result.failures.size() > shown)
      fmt::print("FAILED  {}: and {} more\n", check, result.failures.size() - shown);
  }
  for (const auto& input : result.left_out) fmt::print("        {}: left out: {}\n", check, input);
  std::fflush(stdout);
}

Json to_json(const CheckResult& result) {
  return {{"name", result.name},         {"status", result.ok() ? "ok" : "failed"},
          {"inputs", result.inputs},     {"failures", result.failures},
          {"left_out", result.left_out}, {"measured", result.measured},
          {"seconds", result.seconds}};
}

// Whether all checks passed.
bool check(const std::string& name_or_path, const ConformanceOptions& options, bool json) {
  const MethodInfo method = find(name_or_path);
  Json checks = Json::array();
  bool ok = true;
  check_conformance(method, options, [&](const CheckResult& result) {
    ok = ok && result.ok();
    checks.push_back(to_json(result));
    if (!json) print(method.name, result);
  });
  if (json) {
    const Json report = {{"method", method.name},
                         {"library", method.library.string()},
                         {"status", ok ? "ok" : "failed"},
                         {"checks", std::move(checks)}};
    fmt::print("{}\n", report.dump(2));
  }
  return ok;
}

}  // namespace

void add_check_method_command(CLI::App& app, CommandResult* result) {
  auto name = std::make_shared<std::string>();
  auto options = std::make_shared<ConformanceOptions>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("check-method", "hold a method to what every method must keep to");
  command->footer(
      "Checks, each on empty, black, tiny, odd and large halves where it matters:\n"
      "  repeatable  one seed gives the same lights to the bit, another seed others\n"
      "  lights      all written, finite, unit axes, no power from nothing, at each parameter's ends too\n"
      "  flux        their power is the texels' within the method's flux_bound, at the parameters' ends too\n"
      "  passes      every dispatch is in a named, timed pass, the same ones each frame\n"
      "  bounds      nothing is written past the lights or a scratch buffer, up to 64 MiB behind each\n"
      "  memory      no frame takes more than the first, and all is given back\n"
      "  validation  the Vulkan validation layers are silent, synchronisation included\n"
      "  image       whole frames of a scene: repeatable, finite, black without light\n"
      "Exit codes: 0 all checks ok, 1 one failed, 2 no such method or plugin refused, 3 no usable device.\n"
      "Examples: vsglbench check-method mfis\n"
      "          vsglbench check-method build/plugins/my-method.so --only lights flux");
  command->add_option("method", *name, "NAME, or the path of a plugin (anything with a '/' or ending in .so)")
      ->required();
  command->add_option("--only", options->only, "checks to run (default: all)")
      ->check(CLI::IsMember(conformance_checks()));
  command
      ->add_option("--time-limit", options->silence_s,
                   "seconds that a check may be silent before it is stopped")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--device", options->device, "index, UUID, PCI address or part of a device's name");
  command->add_flag("--json", *json, "as JSON");
  command->callback([=] { result->exit_code = check(*name, *options, *json) ? 0 : 1; });
}

}  // namespace vsglbench
