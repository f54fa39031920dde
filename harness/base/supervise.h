// One supervised worker: jobs done in a process of its own. A job that crashes, hangs or throws costs itself:
// it is lost, and a new worker goes on with the jobs that are left.
//
// Only for a caller without threads and without a Vulkan device: it forks (base/child.h).
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json.h"

namespace vsglbench {

class ToParent;
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// What a worker does at this moment: its end is blamed on this.
struct Task {
  std::optional<size_t> job;  // none: work for all of them, such as opening the device
  std::string action = "starting";
  double limit_s = kNoLimit;  // a worker that is silent for longer hangs, and is stopped
};

// How a worker ended before its jobs were done.
struct End {
  ErrorKind kind;   // crashed, timeout, that of the Error which left the work, or internal
  std::string how;  // "crashed (signal 11, Segmentation fault)", or what the Error says
  Task task;        // the last
  std::string message() const { return how + " during " + task.action; }
};

// The worker's line to its supervisor, of what is no type yet.
class WorkerLine {
 public:
  explicit WorkerLine(const ToParent& parent) : parent_(parent) {}
  void send(const std::optional<Task>& task, const std::optional<Json>& message,
            std::optional<size_t> done) const;

 private:
  const ToParent& parent_;
};

// The worker's end of the line. A message arrives whole or not at all, and in order. Message has
//   Json to_json(const Message&);  void from_json(const Json&, Message*);
// and throws Json::exception for what is none.
template <class Message>
class Worker {
 public:
  explicit Worker(const WorkerLine& line) : line_(line) {}
  void now(const Task& task) const { line_.send(task, {}, {}); }
  void now(const Task& task, const Message& message) const { line_.send(task, to_json(message), {}); }
  void tell(const Message& message) const { line_.send({}, to_json(message), {}); }
  // The job is not lost any more, whatever comes.
  void done(size_t job) const { line_.send({}, {}, job); }
  void done(size_t job, const Message& message) const { line_.send({}, to_json(message), job); }

 private:
  const WorkerLine& line_;
};

template <class Message>
struct Supervision {
  std::string name;  // in the log
  size_t jobs = 1;
  // In the worker: does the jobs that are left, in any order.
  std::function<void(const Worker<Message>&, const std::vector<size_t>& left)> work;
  // In the caller. Each job is either done or lost once; what these throw ends the worker and the
  // supervision.
  std::function<void(const Message&)> told;
  std::function<void(size_t job, const End&)> lost;
  std::function<void(const End&)> died = {};  // after what a worker's end has lost; may be empty
};

// The same, of messages that are no type yet: `told` returns false for what is none.
struct UntypedSupervision {
  std::string name;
  size_t jobs = 1;
  std::function<void(const WorkerLine&, const std::vector<size_t>& left)> work;
  std::function<bool(const Json&)> told;
  std::function<void(size_t job, const End&)> lost;
  std::function<void(const End&)> died;
};
void supervise(const UntypedSupervision& supervision);

// Starts workers until each job is done or lost. The end of one loses the job that it was at; at none, all
// that are left, but for a worker that crashed before it said anything: it is started once more. Throws
// Error(case_failed) when the system has no room for a process.
template <class Message>
void supervise(const Supervision<Message>& s) {
  const auto told = [&](const Json& json) {
    Message message;
    try {
      from_json(json, &message);
    } catch (const std::exception&) {  // a key that is missing, a value of another type
      return false;
    }
    s.told(message);
    return true;
  };
  supervise(UntypedSupervision{
      s.name, s.jobs, [&](const WorkerLine& line, const auto& left) { s.work(Worker<Message>(line), left); },
      told, s.lost, s.died});
}

}  // namespace vsglbench
