#include "run/runner.h"

#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>

#include "base/file.h"
#include "base/log.h"
#include "gpu/shader_compiler.h"
#include "measure/stopwatch.h"
#include "report/environment.h"
#include "run/report_store.h"
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
  if (cases.empty()) {
    throw fail(ErrorKind::usage, "--only '{}' matches none of the {} cases, such as {}", only,
               config.cases.size(), config.cases.front().id);
  }
  return cases;
}

std::vector<Case> of_scene(const std::vector<Case>& cases, const std::string& scene) {
  std::vector<Case> out;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(out),
               [&](const Case& c) { return c.scene == scene; });
  return out;
}

// Whether an interrupted run left nothing to do: a scene whose asset was absent, or that a lost device cut
// short, is tried again.
bool is_done(const Report& report, const std::vector<Case>& cases) {
  return std::all_of(cases.begin(), cases.end(), [&](const Case& c) {
    return std::any_of(report.cases.begin(), report.cases.end(), [&](const CaseResult& r) {
      return r.id == c.id && r.status != Status::skipped && !(r.error && r.error->kind == "device");
    });
  });
}

void remove_scene(Report* report, const std::string& scene) {
  std::erase_if(report->scenes, [&](const SceneReport& s) { return s.name == scene; });
  std::erase_if(report->cases, [&](const CaseResult& c) { return c.scene == scene; });
  if (report->aa && report->aa->case_id.starts_with(scene + "/")) report->aa.reset();
}

void add(SceneOutcome outcome, Report* report) {
  if (outcome.scene) report->scenes.push_back(*outcome.scene);
  if (outcome.aa) report->aa = outcome.aa;
  std::move(outcome.cases.begin(), outcome.cases.end(), std::back_inserter(report->cases));
}

// `earlier` plus what this process has spent since.
WallTime sum(const WallTime& earlier, WallTime now, double total_s) {
  now.total_s = earlier.total_s + total_s;
  now.device_s += earlier.device_s;
  now.references_s += earlier.references_s;
  now.visibility_s += earlier.visibility_s;
  now.compilation_s += earlier.compilation_s;
  const double rest = now.total_s - now.references_s - now.visibility_s - now.compilation_s;
  now.overhead_ratio = now.device_s > 0 ? std::max(0.0, rest) / now.device_s : 0;
  return now;
}

bool has_device_error(const std::vector<CaseResult>& cases) {
  return std::any_of(cases.begin(), cases.end(),
                     [](const CaseResult& c) { return c.error && c.error->kind == "device"; });
}

// Whether the device still does as it is told.
bool is_lost(Device& device) {
  try {
    device.run_once([](VkCommandBuffer) {});
    return false;
  } catch (const Error&) {
    return true;
  }
}

Report fresh_report(const RunOptions& options, const Config& config, const DeviceInfo& device) {
  Report report;
  report.created = utc_now();
  report.argv = options.argv;
  report.git = build_git();
  report.kernels = kernel_sources_hash();
  report.device = describe(device);
  report.host = host_info();
  report.config = config.resolved;
  if (!options.only.empty()) report.config["only"] = options.only;
  return report;
}

int exit_code(const RunOutcome& outcome, bool lost) {
  const bool failed = std::any_of(outcome.report.cases.begin(), outcome.report.cases.end(),
                                  [](const CaseResult& c) { return c.status == Status::failed; });
  return lost ? 3 : failed || !outcome.validation_messages.empty() ? 1 : 0;
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
  ReportStore store(options.out.empty() ? fs::path("reports") / "out" / config.name : options.out);
  Device device({.select = options.device, .validation = options.validation});
  log_info("{} ({}, {})", device.info().name, device.info().driver, device.info().driver_version);

  RunOutcome outcome;
  outcome.report_path = store.path();
  Report& report = outcome.report = store.open(fresh_report(options, config, device.info()), options.force);
  if (!report.cases.empty()) log_info("going on with the interrupted run in {}", store.path().string());
  const WallTime earlier = report.wall;
  WallTime now;
  const auto save = [&] {
    report.wall = sum(earlier, now, watch.seconds());
    store.save(report);
  };

  KernelLibrary kernels(device);
  bool lost = false;
  for (const std::string& scene : config.scenes) {
    const std::vector<Case> wanted = of_scene(cases, scene);
    if (wanted.empty() || is_done(report, wanted)) continue;
    remove_scene(&report, scene);
    if (lost) {
      add({failed_cases(wanted, config, "device", "the device was lost in an earlier scene"), {}, {}},
          &report);
      continue;
    }
    const SceneRunOptions scene_options{
        {data_root() / "scenes", assets_directory(options.assets)}, store.path().parent_path(), !report.aa};
    SceneOutcome done = run_scene(device, kernels, scene, config, wanted, scene_options, &now);
    lost = has_device_error(done.cases) && is_lost(device);
    add(std::move(done), &report);
    save();  // what is finished is never lost
  }
  report.complete = !lost;
  save();
  outcome.validation_messages = device.validation_messages();
  outcome.exit_code = exit_code(outcome, lost);
  return outcome;
}

}  // namespace vsglbench
