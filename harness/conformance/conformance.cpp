#include "conformance/conformance.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "base/error.h"
#include "base/nearest.h"
#include "conformance/inspection.h"
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
    // Of the validating device alone: its layers are missing, and the other checks go on.
    parent.send({{check.validation ? "ended" : "unusable", e.what()}, {"kind", e.exit_code()}});
    return;
  }
  try {
    Inspection inspection(*device, loaded, options.large, parent);
    check.run(inspection);
    parent.send({{"done", true}});
  } catch (const std::exception& e) {
    parent.send({{"ended", e.what()}});
  }
}

// Of an error that no input is to blame for, such as a kernel that doesn't compile.
constexpr const char* kEarly = " (before its first input)";

// The parent's part: what the child says, and how it ends.
CheckResult run_check(const ConformanceCheck& check, const MethodInfo& method,
                      const ConformanceOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CheckResult result{.name = check.name};
  std::string where = kEarly;
  bool done = false;  // to its end, or to an error that it told
  Child child([&](const ToParent& parent) { inspect(check, method, options, parent); });
  while (const auto message = child.receive(options.silence_s)) {
    if (message->contains("unusable"))
      throw Error(message->at("kind").get<ErrorKind>(), message->at("unusable").get<std::string>());
    if (message->contains("input")) {
      where = fmt::format(" (on {})", message->at("input").get<std::string>());
      ++result.inputs;
    }
    if (message->contains("ended"))
      result.failures.push_back(message->at("ended").get<std::string>() + where);
    if (message->contains("failure")) result.failures.push_back(message->at("failure"));
    if (message->contains("left_out")) result.left_out.push_back(message->at("left_out"));
    if (message->contains("measured")) result.measured.push_back(message->at("measured"));
    done = done || message->contains("done") || message->contains("ended");
  }
  if (!done || !child.how_it_ended().empty()) {
    const std::string how = child.how_it_ended().empty() ? "ended the process" : child.how_it_ended();
    result.failures.push_back(how + where);
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

// What stopped an earlier check before its first input is not said in full again.
void name_repeated(std::map<std::string, std::string>* told, CheckResult* result) {
  for (std::string& failure : result->failures) {
    if (!failure.ends_with(kEarly)) continue;
    const auto [earlier, is_new] = told->emplace(failure, result->name);
    if (!is_new) failure = fmt::format("the same error as in {}", earlier->second);
  }
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
  std::map<std::string, std::string> told;  // early failures, with the check that had it first
  for (const auto& check : all_conformance_checks()) {
    if (!options.only.empty() && std::ranges::count(options.only, check.name) == 0) continue;
    results.push_back(run_check(check, method, options));
    name_repeated(&told, &results.back());
    on_result(results.back());
  }
  return results;
}

}  // namespace vsglbench
