#include "run/scene_workers.h"

#include <algorithm>
#include <cstdlib>

#include "base/log.h"
#include "base/supervise.h"
#include "run/scene_news.h"

namespace vsglbench {
namespace {

void add_time(const WallTime& more, WallTime* sum) {
  sum->device_s += more.device_s;
  sum->references_s += more.references_s;
  sum->visibility_s += more.visibility_s;
  sum->compilation_s += more.compilation_s;
}

// What is left to do of a scene: these cases, the contact sheet and, last, the A/A pair.
struct Jobs {
  const std::vector<Case>& cases;
  bool aa;
  size_t sheet() const { return cases.size(); }
  size_t twin() const { return cases.size() + 1; }
  size_t count() const { return cases.size() + (aa ? 2 : 1); }
  std::optional<size_t> of(const std::string& case_id) const {
    if (case_id.empty()) return std::nullopt;
    const auto same = [&](const Case& c) { return c.id == case_id; };
    const auto found = std::find_if(cases.begin(), cases.end(), same);
    return found == cases.end() ? twin() : static_cast<size_t>(found - cases.begin());
  }
};

// --- in the worker ---

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

// Tells the caller, and blames each action on its case.
class Reporter : public SceneObserver {
 public:
  Reporter(const Worker<SceneNews>& worker, const Jobs& jobs, const WorkerOptions& options,
           const Device& device)
      : worker_(worker), jobs_(jobs), options_(options), device_(device) {}

  void now(const Activity& a) override {
    worker_.now({jobs_.of(a.case_id), a.action, a.limited ? options_.time_limit_s : kNoLimit}, news());
    if (options_.sabotage) options_.sabotage(a);
  }
  void described(const SceneReport& scene) override {
    SceneNews n = news();
    n.scene = scene;
    worker_.tell(n);
  }
  void scored(const ScoredCase& scored) override {
    SceneNews n = news();
    n.scored = scored;
    worker_.tell(n);
  }
  // Travels with the next action that is announced: between two timed frames there is one message.
  void timed(const std::string& case_id, const FrameTimes& frame) override {
    frames_.emplace_back(case_id, frame);
  }
  void concluded(const CaseResult& result) override {
    SceneNews n = news();
    n.result = result;
    worker_.done(*jobs_.of(result.id), n);
  }
  void paired(const AaPair& pair) override {
    SceneNews n = news();
    n.aa = pair;
    worker_.done(jobs_.twin(), n);
  }
  void finished() { worker_.done(jobs_.sheet(), news()); }

  WallTime wall;

 private:
  SceneNews news() {
    SceneNews n{.frames = std::exchange(frames_, {}), .wall = wall};
    const auto& messages = device_.validation_messages();
    n.validation.assign(messages.begin() + static_cast<ptrdiff_t>(told_), messages.end());
    told_ = messages.size();
    return n;
  }

  const Worker<SceneNews>& worker_;
  const Jobs& jobs_;
  const WorkerOptions& options_;
  const Device& device_;
  std::vector<std::pair<std::string, FrameTimes>> frames_;  // not told yet
  size_t told_ = 0;                                         // validation messages
};

// Whether only the contact sheet is missing.
bool is_undrawn(const SceneOutcome& outcome) {
  return outcome.scene && outcome.scene->contact.empty() &&
         std::any_of(outcome.cases.begin(), outcome.cases.end(),
                     [](const CaseResult& c) { return !c.images.empty(); });
}

// Whether only the prices of its effects are missing.
bool is_unpriced(const Config& config, const SceneOutcome& outcome) {
  return config.price_effects > 0 && outcome.scene && !outcome.scene->effects_priced &&
         std::ranges::any_of(outcome.cases, [](const CaseResult& c) { return c.status == Status::ok; });
}

void work(const Worker<SceneNews>& worker, const std::vector<size_t>& left, const Jobs& jobs,
          const std::string& scene, const Config& config, const WorkerOptions& options,
          const SceneOutcome& earlier) {
  if (options.detach) options.detach();
  std::vector<Case> cases;
  for (const size_t job : left)
    if (job < jobs.cases.size()) cases.push_back(jobs.cases[job]);
  if (cases.empty() && !is_undrawn(earlier) && !is_unpriced(config, earlier)) return;
  const bool aa = std::count(left.begin(), left.end(), jobs.twin()) > 0;
  Device device(options.device);
  Reporter reporter(worker, jobs, options, device);
  KernelLibrary kernels(device);
  run_scene(device, kernels, scene, config, cases, earlier,
            {options.scenes, options.out, device.info().uuid, aa}, reporter, &reporter.wall);
  reporter.finished();
}

// --- in the caller ---

// What the workers of one scene tell, and what they lose.
class SceneWatch {
 public:
  SceneWatch(const std::string& scene, const Config& config, const Jobs& jobs, const Noted& noted,
             SceneOutcome* outcome, WorkerLog* log)
      : scene_(scene),
        config_(config),
        jobs_(jobs),
        noted_(noted),
        outcome_(*outcome),
        log_(*log),
        before_(log->wall) {}

  void take(const SceneNews& news) {
    add(news, &outcome_);
    log_.wall = before_;
    add_time(news.wall, &log_.wall);
    log_.validation_messages.insert(log_.validation_messages.end(), news.validation.begin(),
                                    news.validation.end());
    if (is_worth_noting(news)) noted_(to_json(news));
  }

  // A lost twin costs the A/A pair, and a lost sheet itself.
  void lose(size_t job, const End& end) {
    if (job >= jobs_.cases.size()) return;
    // A device that was lost at no case's fault leaves its cases to be tried again.
    const bool no_fault = !end.task.job && end.kind == ErrorKind::device_lost;
    const std::string message = end.kind == ErrorKind::device
                                    ? "the device can't be opened any more: " + one_line(end.how)
                                : end.kind == ErrorKind::internal ? end.how
                                                                  : message_of(end);
    for (CaseResult& result :
         failed_cases({jobs_.cases[job]}, config_, no_fault ? ErrorKind::device : end.kind, message)) {
      SceneNews news;
      news.result = std::move(result);
      add(news, &outcome_);
      noted_(to_json(news));
    }
  }

  void bury(const End& end) {
    before_ = log_.wall;
    if (end.kind == ErrorKind::device) log_.device_gone = one_line(end.how);
    const bool of_case = end.task.job && *end.task.job < jobs_.cases.size();
    log_warning("{}: {}", of_case ? jobs_.cases[*end.task.job].id : scene_, message_of(end));
    if (!of_case) warn(end);
  }

 private:
  static std::string message_of(const End& end) {
    return fmt::format("{} during {}", one_line(end.how), end.task.action);
  }

  // In the report: no case tells of this end, unless it has cost all that were left.
  void warn(const End& end) {
    if (!outcome_.scene) return;
    SceneNews news;
    news.scene = outcome_.scene;
    news.scene->warnings.push_back(
        fmt::format("a worker process ended at no case's fault{}: {}",
                    end.task.job == jobs_.twin() ? ", and with it the A/A pair" : "", message_of(end)));
    add(news, &outcome_);
    noted_(to_json(news));
  }

  const std::string& scene_;
  const Config& config_;
  const Jobs& jobs_;
  const Noted& noted_;
  SceneOutcome& outcome_;
  WorkerLog& log_;
  WallTime before_;  // of the workers that ended
};

// The message of the worker that only looks at the device.
struct Probed {
  DeviceReport device;
};

Json to_json(const Probed& probed) { return part_to_json(probed.device); }
void from_json(const Json& json, Probed* probed) { probed->device = part_from_json<DeviceReport>(json); }

}  // namespace

DeviceReport probe_device(const WorkerOptions& options) {
  DeviceReport found;
  supervise<Probed>({.name = "opening the device",
                     .work =
                         [&](const Worker<Probed>& worker, const std::vector<size_t>& left) {
                           if (options.detach) options.detach();
                           const Device device(options.device);
                           worker.done(left.front(), {describe(device.info())});
                         },
                     .told = [&](const Probed& probed) { found = probed.device; },
                     .lost =
                         [&](size_t, const End& end) {
                           if (end.kind == ErrorKind::device) throw Error(end.kind, end.how);
                           throw fail(ErrorKind::device, "opening the device {}; see vsglbench doctor",
                                      end.how);
                         }});
  return found;
}

void run_scene_in_workers(const std::string& scene, const Config& config, const std::vector<Case>& cases,
                          bool aa, const WorkerOptions& options, const Noted& noted, SceneOutcome* outcome,
                          WorkerLog* log) {
  std::vector<Case> left;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(left),
               [&](const Case& c) { return !has_result(*outcome, c.id); });
  const Jobs jobs{left, aa && !outcome->aa};
  SceneWatch watch(scene, config, jobs, noted, outcome, log);
  supervise<SceneNews>({.name = scene,
                        .jobs = jobs.count(),
                        .work =
                            [&](const Worker<SceneNews>& worker, const std::vector<size_t>& open) {
                              work(worker, open, jobs, scene, config, options, *outcome);
                            },
                        .told = [&](const SceneNews& news) { watch.take(news); },
                        .lost = [&](size_t job, const End& end) { watch.lose(job, end); },
                        .died = [&](const End& end) { watch.bury(end); }});
}

}  // namespace vsglbench
