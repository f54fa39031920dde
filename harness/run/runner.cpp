#include "run/runner.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "answer/analysis.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "gpu/shader_compiler.h"
#include "measure/stopwatch.h"
#include "method/registry.h"
#include "report/accuracy_notes.h"
#include "report/environment.h"
#include "run/case_run.h"
#include "run/overrides.h"
#include "run/report_store.h"
#include "run/scene_news.h"
#include "run/scene_workers.h"
#include "run/sources.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

Config read_config(const RunOptions& options) {
  Config config = load_config(options.config, parse_overrides(options.set), options.scale, options.scenes);
  for (Case& c : config.cases) c.frame.check_passes = options.check_passes;
  if (options.price_effects > 0) {
    if (config.measure == Measure::generation)
      throw fail(ErrorKind::usage, "{}: measures generation alone, and effects are priced by whole frames",
                 options.config.string());
    config.price_effects = options.price_effects;
    config.resolved["price_effects"] = options.price_effects;
  }
  if (options.check_passes) config.price_effects = 0;  // no times that can be compared
  return config;
}

std::vector<Case> of_scene(const std::vector<Case>& cases, const std::string& scene) {
  std::vector<Case> out;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(out),
               [&](const Case& c) { return c.scene == scene; });
  return out;
}

// A scene whose asset was absent, or a case that no device was left for, is tried again.
bool is_final(const CaseResult& r) {
  return r.status != Status::skipped && !(r.error && r.error->kind == ErrorKind::device);
}

// Whether an interrupted run left nothing to do.
bool is_done(const Report& report, const std::vector<Case>& cases) {
  return std::all_of(cases.begin(), cases.end(), [&](const Case& c) {
    return std::any_of(report.cases.begin(), report.cases.end(),
                       [&](const CaseResult& r) { return r.id == c.id && is_final(r); });
  });
}

// Takes the scene out of the report: what an interrupted run had finished of it.
SceneOutcome take_scene(Report* report, const std::string& scene) {
  SceneOutcome out;
  for (const CaseResult& c : report->cases) {
    if (c.scene == scene && is_final(c)) out.cases.push_back(c);
  }
  for (const SceneReport& s : report->scenes) {
    if (s.name == scene && !out.cases.empty()) out.scene = s;
  }
  std::erase_if(report->scenes, [&](const SceneReport& s) { return s.name == scene; });
  std::erase_if(report->cases, [&](const CaseResult& c) { return c.scene == scene; });
  for (const AaPair& pair : report->aa) {
    if (pair.scene == scene && !out.cases.empty()) out.aa = pair;
  }
  std::erase_if(report->aa, [&](const AaPair& pair) { return pair.scene == scene; });
  return out;
}

// A result that the report's schema refuses would cost the report of all cases: it fails instead.
void refuse_invalid(CaseResult* result) {
  static const Json schema = {{"$ref", "#/$defs/case"}, {"$defs", report_schema().at("$defs")}};
  const std::vector<std::string> violations = schema_violations(part_to_json(*result), schema);
  if (violations.empty()) return;
  CaseResult failed;
  failed.id = result->id;
  failed.scene = result->scene;
  failed.method = result->method;
  failed.measure = result->measure;
  failed.parameters = result->parameters;
  failed.status = Status::failed;
  failed.error =
      CaseError{ErrorKind::internal, one_line("no report takes its result: " + violations.front())};
  *result = std::move(failed);
}

void add(SceneOutcome outcome, const std::vector<Case>& planned, Report* report) {
  if (outcome.scene) report->scenes.push_back(*outcome.scene);
  if (outcome.aa) report->aa.push_back(*outcome.aa);
  sort_like(planned, &outcome.cases);
  for (CaseResult& result : outcome.cases) refuse_invalid(&result);
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

// What an interrupted run noted after its report was last saved; the time that it had spent goes into the
// report.
std::vector<Json> take_notes(const ReportStore& store, Report* report) {
  const std::vector<Json> noted = store.noted();
  for (const Json& line : noted) {
    try {
      report->wall = part_from_json<WallTime>(line.at("wall"));
    } catch (const std::exception&) {  // take_noted() tells of what is damaged
    }
  }
  return noted;
}

// A line that is no news costs itself: what it told is measured again.
void take_noted(const std::vector<Json>& noted, const std::string& scene, SceneOutcome* outcome) {
  size_t damaged = 0;
  for (const Json& line : noted) {
    try {
      if (line.at("scene") == scene) take_news(line.at("news"), outcome);
    } catch (const std::exception&) {
      ++damaged;
    }
  }
  if (damaged > 0) log_warning("{}: {} damaged lines of the journal are passed over", scene, damaged);
}

Report fresh_report(const RunOptions& options, const Config& config, const DeviceReport& device) {
  Report report;
  report.created = utc_now();
  report.argv = options.argv;
  report.git = build_git();
  report.kernels = sources_hash(config);
  report.device = device;
  report.host = host_info();
  report.config = config.resolved;
  if (!options.only.empty()) report.config["only"] = options.only;
  if (options.check_passes) report.config["check_passes"] = true;
  return report;
}

int exit_code(const RunOutcome& outcome, bool device_gone) {
  const bool failed = std::any_of(outcome.report.cases.begin(), outcome.report.cases.end(),
                                  [](const CaseResult& c) { return c.status == Status::failed; });
  if (device_gone) return exit_code(ErrorKind::device);
  return failed || !outcome.validation_messages.empty() ? exit_code(ErrorKind::case_failed) : 0;
}

WorkerOptions worker_options(const RunOptions& options, const Config& config, ReportStore& store) {
  // Absolute: a method may change the folder that its process works in.
  const fs::path assets = assets_directory(options.assets);
  return {.device = {.select = options.device, .validation = options.validation},
          .scenes = {data_root() / "scenes", assets.empty() ? assets : fs::absolute(assets)},
          .out = fs::absolute(store.path().parent_path()),
          .time_limit_s = options.time_limit_s > 0 ? options.time_limit_s : config.time_limit_s,
          .detach = [&store] { store.leave_to_parent(); },
          .sabotage = options.sabotage};
}

}  // namespace

std::string sources_hash(const Config& config) {
  std::set<std::string> methods;
  for (const Case& c : config.cases) methods.insert(c.method);
  Hasher hasher;
  hasher.text(kernel_sources_hash());
  for (const auto& name : methods) hasher.text(plugin_hash(find_method(name)));
  return hasher.hex();
}

fs::path assets_directory(const fs::path& given) {
  if (!given.empty()) return given;
  const char* env = std::getenv("VSGLBENCH_ASSETS");
  return env ? fs::path(env) : fs::path();
}

RunOutcome run_config(const RunOptions& options) {
  const Stopwatch watch;
  const Config config = read_config(options);
  const std::vector<Case> cases = select_cases(config.cases, options.only, "--only");
  ReportStore store(options.out.empty() ? fs::path("reports") / "out" / config.name : options.out);
  const WorkerOptions workers = worker_options(options, config, store);
  const DeviceReport device = probe_device(workers);
  log_info("{} ({}, {})", device.name, device.driver, device.driver_version);
  if (options.check_passes) log_warning("every pass runs by itself and is checked: times are not comparable");

  RunOutcome outcome;
  outcome.report_path = store.path();
  const Report fresh = fresh_report(options, config, device);
  if (options.keep_complete) {
    if (auto finished = store.finished(fresh)) {
      outcome.report = std::move(*finished);
      outcome.exit_code = exit_code(outcome, false);
      return outcome;
    }
  }
  Report& report = outcome.report = store.open(fresh, options.force, options.keep_complete);
  const std::vector<Json> noted = take_notes(store, &report);
  if (!report.cases.empty() || !noted.empty())
    log_info("going on with the interrupted run in {}", store.path().string());
  report.host.load_at_start = std::max(report.host.load_at_start, load_average());  // of all its starts
  const WallTime earlier = report.wall;
  WorkerLog log;
  const auto save = [&](Report& state) {
    for (SceneReport& scene : state.scenes) scene.notes = accuracy_notes(state.cases, scene.name);
    state.wall = sum(earlier, log.wall, watch.seconds());
    state.host.load_at_end = load_average();
    state.analysis = analysis_of(state);
    store.save(state);
  };
  if (noted.empty()) store.forget_notes(report);

  for (const std::string& scene : config.scenes) {
    const std::vector<Case> wanted = of_scene(cases, scene);
    if (wanted.empty() || is_done(report, wanted)) continue;
    SceneOutcome done = take_scene(&report, scene);
    take_noted(noted, scene, &done);
    const auto note = [&](const Json& news) {
      const WallTime wall = sum(earlier, log.wall, watch.seconds());
      store.note({{"scene", scene}, {"wall", part_to_json(wall)}, {"news", news}});
    };
    if (log.device_gone.empty()) {
      const bool aa = !options.check_passes && !done.aa;
      run_scene_in_workers(scene, config, wanted, aa, workers, note, &done, &log);
    } else {
      for (auto& result :
           failed_cases(wanted, config, ErrorKind::device, "the device was lost in an earlier scene"))
        done.cases.push_back(result);
    }
    add(std::move(done), wanted, &report);
    save(report);
    store.forget_notes(report);
  }
  report.complete = log.device_gone.empty();
  save(report);
  if (report.complete) store.close();
  for (const SceneReport& scene : report.scenes) {
    for (const auto& note : scene.notes) log_warning("{}: {}", scene.name, note);
  }
  outcome.validation_messages = log.validation_messages;
  outcome.exit_code = exit_code(outcome, !log.device_gone.empty());
  return outcome;
}

}  // namespace vsglbench
