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

// What stands behind an error that no input is to blame for, such as a kernel that doesn't compile.
constexpr const char* kEarly = "before its first input";

void add(const CheckNews& news, CheckResult* result) {
  switch (news.kind) {
    case CheckNews::Kind::input:
      ++result->inputs;
      return;
    case CheckNews::Kind::failure:
      return result->failures.push_back(news.text);
    case CheckNews::Kind::left_out:
      return result->left_out.push_back(news.text);
    case CheckNews::Kind::measured:
      return result->measured.push_back(news.text);
  }
}

// In the worker.
void inspect(const ConformanceCheck& check, const MethodInfo& method, const ConformanceOptions& options,
             const Worker<CheckNews>& worker) {
  const Task first{0, kEarly, options.silence_s};
  // That the layers of the validating device are missing is its check's fault alone: the others go on.
  worker.now(check.validation ? first : Task{{}, "opening the device", options.silence_s});
  Device device({.select = options.device, .validation = check.validation});
  const MethodInfo loaded = method.create ? method : load_plugin(method.library, device.info());
  worker.now(first);
  Inspection inspection(device, loaded, options, worker);
  check.run(inspection);
}

// In the caller: what the worker says, and how it ends.
CheckResult run_check(const ConformanceCheck& check, const MethodInfo& method,
                      const ConformanceOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CheckResult result{.name = check.name};
  supervise<CheckNews>({.name = check.name,
                        .work =
                            [&](const Worker<CheckNews>& worker, const std::vector<size_t>& left) {
                              inspect(check, method, options, worker);
                              worker.done(left.front());
                            },
                        .told = [&](const CheckNews& news) { add(news, &result); },
                        .lost =
                            [&](size_t, const End& end) {
                              const bool unusable =
                                  end.kind == ErrorKind::device || end.kind == ErrorKind::plugin;
                              if (unusable && !end.task.job) throw Error(end.kind, end.how);
                              result.failures.push_back(fmt::format("{} ({})", end.how, end.task.action));
                            }});
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

// What stopped an earlier check before its first input is not said in full again.
void name_repeated(std::map<std::string, std::string>* told, CheckResult* result) {
  for (std::string& failure : result->failures) {
    if (!failure.ends_with(fmt::format(" ({})", kEarly))) continue;
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
