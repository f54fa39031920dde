#include "frame/conformance.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "base/nearest.h"
#include "frame/conformance_inspection.h"
#include "method/registry.h"

namespace vsglbench {
namespace {

// The child's part: device, method, check. What keeps every check from running is told apart.
void inspect(const ConformanceCheck& check, const MethodInfo& method, const ConformanceOptions& options,
             const ToParent& parent) {
  std::unique_ptr<Device> device;
  MethodInfo loaded;
  try {
    device =
        std::make_unique<Device>(DeviceOptions{.select = options.device, .validation = check.validation});
    loaded = method.create ? method : load_plugin(method.library, device->info());
  } catch (const Error& e) {
    if (check.validation) throw;  // the layers are missing
    parent.send({{"unusable", e.what()}, {"kind", e.exit_code()}});
    return;
  }
  Inspection inspection(*device, loaded, options.large, parent);
  check.run(inspection);
  parent.send({{"done", true}});
}

// The parent's part: what the child says, and how it ends.
CheckResult run_check(const ConformanceCheck& check, const MethodInfo& method,
                      const ConformanceOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CheckResult result{.name = check.name};
  std::string input = "the way to its first input";
  bool done = false;
  Child child([&](const ToParent& parent) { inspect(check, method, options, parent); });
  while (const auto message = child.receive(options.silence_s)) {
    if (message->contains("unusable"))
      throw Error(message->at("kind").get<ErrorKind>(), message->at("unusable").get<std::string>());
    if (message->contains("input")) {
      input = message->at("input");
      ++result.inputs;
    }
    if (message->contains("failure")) result.failures.push_back(message->at("failure"));
    if (message->contains("left_out")) result.left_out.push_back(message->at("left_out"));
    if (message->contains("measured")) result.measured.push_back(message->at("measured"));
    done = done || message->contains("done");
  }
  if (!done || !child.how_it_ended().empty()) {
    const std::string how = child.how_it_ended().empty() ? "ended the process" : child.how_it_ended();
    result.failures.push_back(fmt::format("{} on {}", how, input));
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace

std::vector<std::string> conformance_checks() {
  std::vector<std::string> names;
  for (const auto& check : all_conformance_checks()) names.emplace_back(check.name);
  return names;
}

std::vector<CheckResult> check_conformance(const MethodInfo& method, const ConformanceOptions& options,
                                           const std::function<void(const CheckResult&)>& on_result) {
  if (!method.refused.empty()) throw Error(ErrorKind::plugin, method.refused);
  const auto known = conformance_checks();
  for (const auto& name : options.only) {
    if (std::ranges::count(known, name) == 0)
      throw fail(ErrorKind::usage, "no check '{}'{}", name, suggestion(name, known));
  }
  std::vector<CheckResult> results;
  for (const auto& check : all_conformance_checks()) {
    if (!options.only.empty() && std::ranges::count(options.only, check.name) == 0) continue;
    results.push_back(run_check(check, method, options));
    on_result(results.back());
  }
  return results;
}

}  // namespace vsglbench
