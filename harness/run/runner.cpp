#include "run/runner.h"

#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "base/file.h"
#include "base/log.h"
#include "measure/stopwatch.h"
#include "report/environment.h"
#include "run/scene_run.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

DeviceReport describe(const DeviceInfo& info) {
  DeviceReport d{.name = info.name,
                 .type = info.type,
                 .driver = info.driver,
                 .driver_version = info.driver_version,
                 .api = info.api,
                 .subgroup_size = info.subgroup_size,
                 .timestamp_period_ns = info.timestamp_period_ns};
  // What changes how fast or how exactly a driver computes.
  for (const char* name : {"LP_NATIVE_VECTOR_WIDTH", "LP_NUM_THREADS", "MESA_SHADER_CACHE_DISABLE"}) {
    if (const char* value = std::getenv(name)) d.settings[name] = value;
  }
  return d;
}

std::vector<Case> select(const Config& config, const std::string& only) {
  std::vector<Case> cases;
  for (const Case& c : config.cases) {
    if (only.empty() || ::fnmatch(only.c_str(), c.id.c_str(), 0) == 0) cases.push_back(c);
  }
  if (cases.empty()) throw fail(ErrorKind::usage, "--only '{}' matches none of the {} cases", only, config.cases.size());
  return cases;
}

bool same_machine(const DeviceReport& a, const DeviceReport& b) {
  return a.name == b.name && a.driver_version == b.driver_version && a.settings == b.settings;
}

// The report to go on with: an interrupted run of the same experiment, program and device keeps its finished
// scenes; anything else starts anew, and a complete report moves aside.
Report resume_or_start(const fs::path& path, const Report& fresh, bool force) {
  std::error_code ec;
  if (!fs::exists(path, ec)) return fresh;
  try {
    Report old = read_report(path);
    const bool same = old.config == fresh.config && old.git.commit == fresh.git.commit &&
                      old.git.dirty == fresh.git.dirty && same_machine(old.device, fresh.device);
    if (!force && !old.complete && same) {
      log_info("going on with the interrupted run in {} ({} cases are done)", path.string(), old.cases.size());
      old.argv = fresh.argv;
      return old;
    }
  } catch (const Error& e) {
    log_warning("{}; starting anew", e.what());
  }
  fs::rename(path, path.parent_path() / "report.previous.json", ec);
  if (ec) throw fail(ErrorKind::output, "{}: the earlier report can't be moved aside: {}", path.string(), ec.message());
  return fresh;
}

bool scene_done(const Report& report, const std::string& scene) {
  return std::any_of(report.cases.begin(), report.cases.end(), [&](const CaseResult& c) { return c.scene == scene; });
}

void add(Report& report, SceneOutcome outcome) {
  if (outcome.scene) report.scenes.push_back(*outcome.scene);
  if (outcome.aa) report.aa = outcome.aa;
  for (auto& c : outcome.cases) report.cases.push_back(std::move(c));
}

}  // namespace

fs::path assets_directory(const fs::path& given) {
  if (!given.empty()) return given;
  const char* env = std::getenv("VSGLBENCH_ASSETS");
  return env ? fs::path(env) : fs::path();
}

RunOutcome run_config(const RunOptions& options) {
  const Stopwatch watch;
  const Config config = load_config(options.config);
  const std::vector<Case> cases = select(config, options.only);
  const fs::path out = options.out.empty() ? fs::path("reports") / "out" / config.name : options.out;
  ensure_writable_directory(out);

  Device device({.select = options.device, .validation = options.validation});
  log_info("{} ({}, {})", device.info().name, device.info().driver, device.info().driver_version);
  RunOutcome outcome;
  outcome.report_path = out / "report.json";
  Report fresh;
  fresh.created = utc_now();
  fresh.argv = options.argv;
  fresh.git = build_git();
  fresh.device = describe(device.info());
  fresh.host = host_info();
  fresh.config = config.resolved;
  if (!options.only.empty()) fresh.config["only"] = options.only;
  Report& report = outcome.report = resume_or_start(outcome.report_path, fresh, options.force);

  KernelLibrary kernels(device);
  for (const std::string& scene : config.scenes) {
    std::vector<Case> of_scene;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(of_scene), [&](const Case& c) { return c.scene == scene; });
    if (of_scene.empty() || scene_done(report, scene)) continue;
    const SceneRunOptions scene_options{
        {data_root() / "scenes", assets_directory(options.assets)}, out, !report.aa.has_value()};
    add(report, run_scene(device, kernels, scene, config, of_scene, scene_options, &outcome.wall));
    write_report(outcome.report_path, report);  // what is finished is never lost
  }
  report.complete = true;
  outcome.wall.total = watch.seconds();
  write_report(outcome.report_path, report);
  const bool failed = std::any_of(report.cases.begin(), report.cases.end(),
                                  [](const CaseResult& c) { return c.status == Status::failed; });
  outcome.exit_code = failed ? 1 : 0;
  if (!device.validation_messages().empty()) {
    throw fail(ErrorKind::device, "the validation layers gave {} messages, the first: {}",
               device.validation_messages().size(), device.validation_messages().front());
  }
  return outcome;
}

}  // namespace vsglbench
