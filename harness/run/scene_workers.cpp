#include "run/scene_workers.h"

#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "base/child.h"
#include "base/error.h"
#include "base/log.h"

namespace vsglbench {
namespace {

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

// Ctrl-C is the parent's to answer; when it ends so does this process.
void become_worker(const WorkerOptions& options) {
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_IGN);
  if (options.detach) options.detach();
}

// Tells the parent, every time with what the validation layers have said and the time that was spent.
class Reporter : public SceneObserver {
 public:
  Reporter(const ToParent& parent, const Device& device, const Announce& sabotage)
      : parent_(parent), device_(device), sabotage_(sabotage) {}

  void now(const Activity& a) override {
    send({{"activity", {{"case", a.case_id}, {"action", a.action}, {"limited", a.limited}}}});
    if (sabotage_) sabotage_(a);
  }
  void described(const SceneReport& scene) override { send({{"scene", part_to_json(scene)}}); }
  void concluded(const CaseResult& result) override { send({{"case", part_to_json(result)}}); }
  void paired(const AaPair& pair) override { send({{"aa", part_to_json(pair)}}); }

  void send(Json message) {
    message["wall"] = part_to_json(wall);
    const auto& messages = device_.validation_messages();
    for (; told_ < messages.size(); ++told_) message["validation"].push_back(messages[told_]);
    parent_.send(message);
  }

  WallTime wall;

 private:
  const ToParent& parent_;
  const Device& device_;
  const Announce& sabotage_;
  size_t told_ = 0;  // validation messages
};

void work(const ToParent& parent, const std::string& scene, const Config& config,
          const std::vector<Case>& cases, bool aa, const WorkerOptions& options,
          const SceneOutcome& earlier) {
  become_worker(options);
  std::unique_ptr<Device> device;
  try {
    device = std::make_unique<Device>(options.device);
  } catch (const Error& e) {
    return parent.send({{"no_device", one_line(e.what())}});
  }
  Reporter reporter(parent, *device, options.sabotage);
  try {
    KernelLibrary kernels(*device);
    run_scene(*device, kernels, scene, config, cases, earlier, {options.scenes, options.out, aa}, reporter,
              &reporter.wall);
    reporter.send({{"done", true}});
  } catch (const Error& e) {
    reporter.send({{"device_lost", one_line(e.what())}});
  }
}

// --- in the parent ---

constexpr const char* kStarting = "starting";  // until a worker says more
constexpr double kForEver = std::numeric_limits<double>::infinity();

void add(const WallTime& more, WallTime* sum) {
  sum->device_s += more.device_s;
  sum->references_s += more.references_s;
  sum->visibility_s += more.visibility_s;
  sum->compilation_s += more.compilation_s;
}

bool has_result(const SceneOutcome& outcome, const std::string& id) {
  return std::any_of(outcome.cases.begin(), outcome.cases.end(),
                     [&](const CaseResult& r) { return r.id == id; });
}

std::vector<Case> without_result(const std::vector<Case>& cases, const SceneOutcome& outcome) {
  std::vector<Case> out;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(out),
               [&](const Case& c) { return !has_result(outcome, c.id); });
  return out;
}

// How a worker ended, and at what.
struct End {
  bool done = false;
  std::string kind, how;  // unless done: as CaseError; no_device apart
  std::string no_device;
  Activity activity{"", kStarting, false};

  std::string message() const { return one_line(how) + " during " + activity.action; }
};

// Follows one worker to its end; what it tells goes to `outcome` and `log`.
class Watch {
 public:
  Watch(SceneOutcome* outcome, WorkerLog* log) : outcome_(*outcome), log_(*log) {}

  End follow(Child& child, double time_limit_s) {
    while (!end_.done && end_.how.empty() && end_.no_device.empty()) {
      const auto message = child.receive(end_.activity.limited ? time_limit_s : kForEver);
      if (message) {
        try {
          take(*message);
        } catch (const std::exception&) {  // a key that is missing, a value of another type
          end_.kind = "crashed";
          end_.how = "sent what is no message";
        }
      } else {
        end_.kind = child.timed_out() ? "timeout" : "crashed";
        end_.how = child.how_it_ended().empty() ? "ended the process (exit code 0)" : child.how_it_ended();
      }
    }
    if (end_.done) {
      while (child.receive(time_limit_s)) {  // lets it give everything back
      }
    }
    add(wall_, &log_.wall);
    return end_;
  }

 private:
  void take(const Json& m) {
    if (m.contains("activity")) {
      const Json& a = m["activity"];
      end_.activity = {a.at("case"), a.at("action"), a.at("limited")};
    }
    if (m.contains("scene")) outcome_.scene = part_from_json<SceneReport>(m["scene"]);
    if (m.contains("case") && !has_result(outcome_, m["case"].at("id")))
      outcome_.cases.push_back(part_from_json<CaseResult>(m["case"]));
    if (m.contains("aa")) outcome_.aa = part_from_json<AaPair>(m["aa"]);
    if (m.contains("wall")) wall_ = part_from_json<WallTime>(m["wall"]);
    if (m.contains("validation"))
      for (const auto& text : m["validation"]) log_.validation_messages.push_back(text);
    if (m.contains("no_device")) end_.no_device = m["no_device"];
    if (m.contains("device_lost")) {
      end_.kind = "device_lost";
      end_.how = m["device_lost"];
    }
    end_.done = m.contains("done");
  }

  SceneOutcome& outcome_;
  WorkerLog& log_;
  WallTime wall_;  // of this worker, so far
  End end_;
};

// Whether anything is left to do: cases, or the contact sheet of those that were measured.
bool needs_worker(const std::vector<Case>& left, const SceneOutcome& outcome) {
  const bool undrawn = outcome.scene && outcome.scene->contact.empty() &&
                       std::any_of(outcome.cases.begin(), outcome.cases.end(),
                                   [](const CaseResult& c) { return !c.images.empty(); });
  return !left.empty() || undrawn;
}

}  // namespace

DeviceReport probe_device(const WorkerOptions& options) {
  Child child([&](const ToParent& parent) {
    become_worker(options);
    try {
      const Device device(options.device);
      parent.send({{"device", part_to_json(describe(device.info()))}});
    } catch (const Error& e) {
      parent.send({{"no_device", e.what()}});
    }
  });
  const auto answer = child.receive(kForEver);
  if (!answer) {
    throw fail(ErrorKind::device, "opening the device {}; see vsglbench doctor",
               child.how_it_ended().empty() ? "ended the process" : child.how_it_ended());
  }
  try {
    if (answer->contains("no_device")) throw Error(ErrorKind::device, answer->at("no_device"));
    return part_from_json<DeviceReport>(answer->at("device"));
  } catch (const Json::exception& e) {
    throw fail(ErrorKind::device, "opening the device sent what is no message: {}", e.what());
  }
}

void run_scene_in_workers(const std::string& scene, const Config& config, const std::vector<Case>& cases,
                          bool aa, const WorkerOptions& options, const std::function<void()>& died,
                          SceneOutcome* outcome, WorkerLog* log) {
  const auto fail_all = [&](const std::vector<Case>& which, const std::string& kind,
                            const std::string& message) {
    for (auto& result : failed_cases(which, config, kind, message)) outcome->cases.push_back(result);
  };
  std::vector<Case> left = without_result(cases, *outcome);
  bool started_twice = false;
  while (needs_worker(left, *outcome)) {
    End end;
    {
      Child child([&](const ToParent& parent) {
        work(parent, scene, config, left, aa && !outcome->aa, options, *outcome);
      });
      end = Watch(outcome, log).follow(child, options.time_limit_s);
    }
    left = without_result(cases, *outcome);
    if (end.done) return fail_all(left, "internal", "the worker process left this case out");
    if (!end.no_device.empty()) {
      log->device_gone = end.no_device;
      return fail_all(left, "device", "the device can't be opened any more: " + end.no_device);
    }
    // 1. Nothing had begun: whoever killed it may leave the next alone.
    if (end.activity.action == kStarting && end.kind == "crashed" && !started_twice) {
      started_twice = true;
      log_warning("{}: {}; it is started once more", scene, end.message());
      continue;
    }
    // 2. Blame. A twin's failure costs the A/A pair.
    const auto guilty =
        std::find_if(left.begin(), left.end(), [&](const Case& c) { return c.id == end.activity.case_id; });
    const bool own_work = end.activity.case_id.empty();
    log_warning("{}: {}", own_work ? scene : end.activity.case_id, end.message());
    if (guilty != left.end()) {
      fail_all({*guilty}, end.kind, end.message());
    } else if (!own_work && aa) {
      aa = false;
    } else {
      fail_all(left, end.kind == "device_lost" ? "device" : end.kind, end.message());
      return died();
    }
    // 3. The rest in a new worker.
    died();
    left = without_result(cases, *outcome);
  }
}

}  // namespace vsglbench
