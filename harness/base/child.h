// Part of the programme in a process of its own: what crashes or hangs there is lost, and nothing else.
//
// fork() without exec(): the child starts with all that the parent holds in memory. Only for a parent
// without threads and without a Vulkan device, neither of which survives a fork.
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>

#include "base/json.h"

namespace vsglbench {

// The child's end: messages to the parent, in order, each received whole or not at all.
class ToParent {
 public:
  explicit ToParent(int pipe) : pipe_(pipe) {}
  // Ends the process when the parent is gone.
  void send(const Json& message) const;

 private:
  int pipe_;
};

class Child {
 public:
  // Runs `body` in a new process, which ends with it. An exception that leaves `body` ends the child as
  // `how_it_ended` tells. Throws Error(case_failed) when the system has no room for a process.
  explicit Child(const std::function<void(const ToParent&)>& body);
  ~Child();  // kills what still runs
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // The next message. Empty when the child has ended, or was silent for `silence_s` seconds (infinity: for
  // ever), for which it is killed.
  std::optional<Json> receive(double silence_s);

  // After an empty receive(): empty when `body` returned, else what happened, as in "crashed (signal 11,
  // Segmentation fault)" or "was stopped after 30 s without a sign of life".
  const std::string& how_it_ended() const { return ended_; }
  bool timed_out() const { return timed_out_; }

 private:
  void reap();
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::string received_;  // bytes of messages not yet complete
  std::string ended_;
  bool timed_out_ = false;
};

}  // namespace vsglbench
