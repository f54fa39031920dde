#include "base/supervise.h"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <utility>

#include "base/child.h"
#include "base/log.h"

namespace vsglbench {
namespace {

constexpr double kFarewell_s = 30;  // from the end of the work to that of the process

Json task_to_json(const Task& task) {
  Json json = {{"action", task.action}};
  if (task.job) json["job"] = *task.job;
  if (std::isfinite(task.limit_s)) json["limit_s"] = task.limit_s;  // JSON knows no infinity
  return json;
}

Task task_from_json(const Json& json) {
  Task task{.action = json.at("action"), .limit_s = json.value("limit_s", kNoLimit)};
  if (json.contains("job")) task.job = json["job"].get<size_t>();
  return task;
}

// --- in the worker ---

void work(const UntypedSupervision& s, const std::vector<size_t>& left, const ToParent& parent) {
  // Ctrl-C is the caller's to answer; when it ends so does this process.
  for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_IGN);
  const auto failed = [&](ErrorKind kind, const std::string& how) {
    parent.send({{"error", name(kind)}, {"how", how}});
  };
  try {
    s.work(WorkerLine(parent), left);
    parent.send({{"returned", true}});
  } catch (const Error& e) {
    failed(e.kind(), e.what());
  } catch (const std::bad_alloc&) {
    failed(ErrorKind::case_failed, "out of memory; make it smaller");
  }
}

// --- in the caller ---

// One worker.
class Watch {
 public:
  Watch(const UntypedSupervision& s, std::vector<size_t>* left) : supervision_(s), left_(*left) {}

  // Nothing when its work returned.
  std::optional<End> follow() {
    Child child([&](const ToParent& parent) { work(supervision_, left_, parent); });
    while (const auto line = child.receive(returned_ ? kFarewell_s : task_.limit_s)) {
      if (!take(*line)) return End{ErrorKind::crashed, "sent what is no message", task_};
    }
    if (returned_) return std::nullopt;
    if (error_) return End{*error_, how_, task_};
    return End{child.timed_out() ? ErrorKind::timeout : ErrorKind::crashed,
               child.how_it_ended().empty() ? "ended the process (exit code 0)" : child.how_it_ended(),
               task_};
  }

 private:
  bool take(const Json& line) {
    if (line.contains("message") && !supervision_.told(line["message"])) return false;
    try {
      if (line.contains("done")) std::erase(left_, line["done"].get<size_t>());
      if (line.contains("task")) task_ = task_from_json(line["task"]);
      if (line.contains("error")) {
        error_ = error_kind(line["error"].get<std::string>()).value();
        how_ = line.at("how");
      }
    } catch (const Json::exception&) {
      return false;
    } catch (const std::bad_optional_access&) {
      return false;
    }
    returned_ = line.contains("returned");
    return true;
  }

  const UntypedSupervision& supervision_;
  std::vector<size_t>& left_;
  Task task_;
  bool returned_ = false;
  std::optional<ErrorKind> error_;
  std::string how_;
};

// Said nothing before it crashed: whoever killed it may leave the next alone.
bool ended_at_once(const std::optional<End>& end) {
  return end && end->kind == ErrorKind::crashed && !end->task.job && end->task.action == Task().action;
}

}  // namespace

void WorkerLine::send(const std::optional<Task>& task, const std::optional<Json>& message,
                      std::optional<size_t> done) const {
  Json line = Json::object();
  if (task) line["task"] = task_to_json(*task);
  if (message) line["message"] = *message;
  if (done) line["done"] = *done;
  parent_.send(line);
}

void supervise(const UntypedSupervision& s) {
  std::vector<size_t> left(s.jobs);
  std::iota(left.begin(), left.end(), size_t{0});
  bool started_twice = false;
  while (!left.empty()) {
    const std::optional<End> end = Watch(s, &left).follow();
    if (left.empty()) return;
    if (ended_at_once(end) && !std::exchange(started_twice, true)) {
      log_warning("{}: {}; it is started once more", s.name, end->message());
      continue;
    }
    const End why = end ? *end : End{ErrorKind::internal, "the worker process left it out", {}};
    const bool guilty = why.task.job && std::ranges::count(left, *why.task.job) > 0;
    const std::vector<size_t> lost = guilty ? std::vector{*why.task.job} : left;
    for (const size_t job : lost) {
      s.lost(job, why);
      std::erase(left, job);
    }
    if (end && s.died) s.died(*end);
  }
}

}  // namespace vsglbench
