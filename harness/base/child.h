// Part of the programme in a process of its own: what crashes or hangs there is lost, and nothing else.
//
// fork() without exec(): the child starts with all that the parent holds in memory. Only for a parent
// without threads and without a Vulkan device, neither of which survives a fork.
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "base/json.h"

namespace vsglbench {

// The child's end: messages to the parent, in order, each received whole or not at all.
class ToParent {
 public:
  ToParent(int pipe, std::string token) : pipe_(pipe), token_(std::move(token)) {}
  // Ends the process when the parent is gone.
  void send(const Json& message) const;

 private:
  int pipe_;
  std::string token_;  // every message begins with it: what else is written to the pipe is no message
};

class Child {
 public:
  // Runs `body` in a new process, which ends with it. An exception that leaves `body` ends the child as
  // `how_it_ended` tells. The child leads a process group of its own: what it starts dies with it. Throws
  // Error(case_failed) when the system has no room for a process.
  explicit Child(const std::function<void(const ToParent&)>& body);
  ~Child();  // kills what still runs, and all that it has started
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // The next message. Empty when the child has ended, whoever still holds its pipe, or was killed: because
  // it was silent for `silence_s` seconds (infinity: for ever), wrote what is no message, or closed its pipe
  // and went on. Never throws for what a child did.
  std::optional<Json> receive(double silence_s);

  // After an empty receive(): empty when `body` returned, else what happened, as in "crashed (signal 11,
  // Segmentation fault)" or "was stopped after 30 s without a sign of life".
  const std::string& how_it_ended() const { return ended_; }
  bool timed_out() const { return timed_out_; }

 private:
  void start(const std::function<void(const ToParent&)>& body);
  std::optional<Json> next_received();
  enum class Pipe { open, empty, closed };
  Pipe read_some();
  bool has_died() const;
  void await_death();
  void stop(const std::string& why);
  void reap();
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::string token_;
  std::string received_;  // bytes of messages not yet complete
  std::string ended_;
  bool timed_out_ = false;
};

// Kills every child of this process, with all that they have started. For a signal handler.
void kill_children() noexcept;

}  // namespace vsglbench
