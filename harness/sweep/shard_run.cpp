#include "sweep/shard_run.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "base/child.h"
#include "base/file.h"
#include "base/log.h"
#include "base/supervise.h"
#include "measure/stopwatch.h"
#include "sweep/device_choice.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

std::atomic<int> stopped_by{0};

// What a run found, as its process tells.
struct Measured {
  DeviceReport device;
  ShardCounts cases;
  int exit_code = 0;
};

Json to_json(const Measured& m) {
  return {{"device", part_to_json(m.device)},
          {"cases", {m.cases.ok, m.cases.failed, m.cases.skipped}},
          {"exit_code", m.exit_code}};
}

void from_json(const Json& json, Measured* m) {
  m->device = part_from_json<DeviceReport>(json.at("device"));
  const Json& cases = json.at("cases");
  m->cases = {cases.at(0), cases.at(1), cases.at(2)};
  m->exit_code = json.at("exit_code");
}

Measured measured(const RunOutcome& outcome) {
  Measured m{outcome.report.device, {}, outcome.exit_code};
  for (const CaseResult& c : outcome.report.cases)
    ++(c.status == Status::ok ? m.cases.ok : c.status == Status::failed ? m.cases.failed : m.cases.skipped);
  return m;
}

// Standard output and error of this process.
void write_to(const fs::path& log) {
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) throw fail(ErrorKind::output, "{}: can't be written: {}", log.string(), std::strerror(errno));
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
}

class Task {
 public:
  Task(const SweepFolder& folder, const SweepPlan& plan, size_t shard, const TaskOptions& options,
       const AttemptLock& lock)
      : folder_(folder), plan_(plan), shard_(shard), options_(options), lock_(lock) {}

  TaskOutcome run() {
    const Stopwatch watch;
    clear_work();
    if (fs::exists(plan_.folder)) fs::current_path(plan_.folder);
    check_unchanged(plan_);
    const DeviceInfo device = find_device(device_wish(options_.device, options_.require));
    const Measured m = measure(device);
    if (m.exit_code == exit_code(ErrorKind::device))
      throw fail(ErrorKind::device, "the device was lost, and could not be opened again");
    if (stopped_by != 0) throw fail(ErrorKind::case_failed, "stopped");
    record(m, device, watch.seconds());
    copy_logs();
    return {TaskOutcome::What::measured, folder_.finish(shard_, lock_.number()), m.cases, {}, m.exit_code};
  }

 private:
  fs::path work() const { return folder_.work(shard_, lock_.number()); }

  // What earlier attempts left that are known to be over.
  void clear_work() const {
    std::error_code ec;
    for (const Attempt& a : attempts_in(folder_.attempts(shard_), options_.silent_s))
      if (a.number != lock_.number() && !a.alive && a.certain)
        fs::remove_all(folder_.work(shard_, a.number), ec);
  }

  RunOptions run_options(const DeviceInfo& device) const {
    RunOptions run = plan_.run;
    run.only = exact_globs(plan_.shards[shard_].cases);
    run.out = work();
    run.device = device.uuid;
    run.argv = {"vsglbench", "sweep", "run", folder_.root().string(), std::to_string(shard_)};
    return run;
  }

  Measured measure(const DeviceInfo& device) const {
    Measured found;
    supervise<Measured>({.name = fmt::format("shard {}", shard_),
                         .work =
                             [&](const Worker<Measured>& worker, const std::vector<size_t>& left) {
                               worker.now({left.front(), "measuring"});
                               for (const int signal : {SIGTERM, SIGINT}) std::signal(signal, SIG_DFL);
                               write_to(lock_.log());
                               worker.done(left.front(), measured(run_config(run_options(device))));
                             },
                         .told = [&](const Measured& m) { found = m; },
                         .lost = [](size_t, const End& end) { throw Error(end.kind, end.how); }});
    return found;
  }

  void record(const Measured& m, const DeviceInfo& device, double seconds) const {
    const AttemptOwner self = this_process();
    HostRecord r{.plan = plan_.hash(), .shard = shard_, .attempt = lock_.number()};
    r.host = self.host;
    r.node = self.node;
    r.job = self.job;
    r.device = m.device;
    r.uuid = device.uuid;
    r.pci = device.pci;
    r.ended = utc_now();
    r.seconds = seconds;
    r.cases = m.cases;
    r.report_bytes = fs::file_size(work() / "report.json");
    write_text(work() / "host.json", to_json(r).dump(1) + "\n");
  }

  void copy_logs() const {
    for (const auto& entry : fs::directory_iterator(folder_.attempts(shard_)))
      if (entry.path().extension() == ".log")
        fs::copy_file(entry.path(), work() / entry.path().filename(), fs::copy_options::overwrite_existing);
  }

  const SweepFolder& folder_;
  const SweepPlan& plan_;
  const size_t shard_;
  const TaskOptions& options_;
  const AttemptLock& lock_;
};

// Tells of the holder's life while it measures; dies with it.
Child pulse_of(const AttemptLock& lock) {
  return Child([&lock](const ToParent&) {
    for (;;) {
      lock.beat();
      std::this_thread::sleep_for(std::chrono::duration<double>(kBeat_s));
    }
  });
}

std::string why(const std::string& what) {
  const int signal = stopped_by;
  return signal == 0 ? what : fmt::format("stopped by signal {}, {}", signal, ::strsignal(signal));
}

TaskOutcome attempt(const SweepFolder& folder, const SweepPlan& plan, size_t shard,
                    const TaskOptions& options, const AttemptLock& lock) {
  const Child pulse = pulse_of(lock);
  const auto over = [&](int code, const std::string& message) {
    lock.end({utc_now(), code, message.empty(), message});
  };
  try {
    const TaskOutcome outcome = Task(folder, plan, shard, options, lock).run();
    over(outcome.exit_code, "");
    return outcome;
  } catch (const WrongDevice& e) {
    over(kWrongDevice, e.what());
    throw;
  } catch (const Error& e) {
    over(e.exit_code(), why(e.what()));
    throw;
  } catch (const std::exception& e) {
    over(exit_code(ErrorKind::internal), why(e.what()));
    throw;
  }
}

}  // namespace

void stop_shard(int signal) noexcept {
  stopped_by = signal;
  kill_children();
}

int shard_stopped_by() noexcept { return stopped_by; }

TaskOutcome run_shard(const fs::path& sweep, size_t shard, const TaskOptions& options) {
  const SweepFolder folder(fs::absolute(sweep));
  const SweepPlan plan = read_plan(folder.root());
  if (shard >= plan.shards.size())
    throw fail(ErrorKind::usage, "{}: has shards 0 to {}, and no {}", sweep.string(), plan.shards.size() - 1,
               shard);
  for (const FinishedShard& f : folder.finished_of(plan.hash(), shard))
    if (f.problem.empty() && is_required(f.record.device.name, f.record.uuid, options.require))
      return {TaskOutcome::What::was_done, f.folder, f.record.cases, {}, 0};
  Attempt holder;
  const auto lock = AttemptLock::take(folder.attempts(shard), &holder, options.silent_s);
  if (!lock) return {TaskOutcome::What::held, {}, {}, holder, 0};
  for (const FinishedShard& f : folder.finished_of(plan.hash(), shard)) {
    if (f.problem.empty()) continue;
    const fs::path aside =
        folder.attempts(shard) / fmt::format("unsound-{}-{}", lock->number(), f.folder.filename().string());
    log_warning("{}: {}; it is moved to {}", f.folder.string(), f.problem, aside.string());
    std::error_code ec;
    fs::rename(f.folder, aside, ec);  // where it stays, this attempt is done beside it
  }
  return attempt(folder, plan, shard, options, *lock);
}

}  // namespace vsglbench
