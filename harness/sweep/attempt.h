// Who works at a shard: DIR/attempts/00017/attempt-N.lock, .end and .log.
//
// Taking a shard is making attempt-N.lock, where N follows the last attempt, which must be over. The file is
// written under a name of its own, synced, and given its name by link(), which fails where the name is taken:
// of any number of tasks that try, one succeeds. That holds on NFS, where link() is one operation of the
// server; when its answer is lost, the number of links of the file tells whether it was done. Nothing is ever
// deleted to take a shard over: whoever finds attempt 3 dead makes attempt 4, and of two who do, link() lets
// one. No clock is trusted but the file server's: a holder touches its lock every few seconds, and is dead
// when the server's time, that of a file written now, is past the last touch by kSilent_s. On the holder's
// own machine its process is looked at instead, so that a death shows at once. A holder that was only held
// up, and goes on after it was taken for dead, does no harm: every attempt writes into a folder of its own,
// and the rename that makes a shard done fails where another task's has been done before.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"

namespace vsglbench {

inline constexpr double kBeat_s = 5, kSilent_s = 60;

// As the lock says.
struct AttemptOwner {
  std::string host;   // name of the machine
  std::string node;   // of the engine's node, such as Slurm's; empty: no engine says
  std::string job;    // of the engine, "123_17"; empty: none
  std::string space;  // of process numbers: the machine's boot and the namespace
  int64_t pid = 0, started_ticks = 0;
  std::string started;  // UTC
};

// As attempt-N.end says, which a task writes that ends by itself or by a signal that it can catch.
struct AttemptEnd {
  std::string ended;  // UTC
  int exit_code = 0;
  bool done = false;    // the shard is
  std::string message;  // why it is not
};

struct Attempt {
  size_t number = 0;
  AttemptOwner owner;
  std::optional<AttemptEnd> end;
  bool alive = false;   // works at it now
  bool certain = true;  // whether it is known to be over, or only silent for too long
  double silent_s = 0;  // since its last sign of life
  bool failed() const { return !alive && !(end && end->done); }
  // "attempt 2 on n1: its process is gone, and it wrote no end"
  std::string told() const;
};

// In order of number. `silent_s`: after which a holder on another machine is dead.
std::vector<Attempt> attempts_in(const std::filesystem::path& folder, double silent_s = kSilent_s);
// The file server's time, in seconds, as times of files there are.
double server_time(const std::filesystem::path& folder);

class AttemptLock {
 public:
  // Takes the shard whose attempts lie in `folder`. Nothing where another task works at it: then `holder`
  // tells which. Throws Error(output).
  static std::optional<AttemptLock> take(const std::filesystem::path& folder, Attempt* holder,
                                         double silent_s = kSilent_s);
  size_t number() const { return number_; }
  std::filesystem::path log() const { return file(".log"); }
  void beat() const noexcept;
  void end(const AttemptEnd& end) const;

 private:
  AttemptLock(std::filesystem::path folder, size_t number) : folder_(std::move(folder)), number_(number) {}
  std::filesystem::path file(const char* extension) const;
  std::filesystem::path folder_;
  size_t number_;
};

// This process as an owner.
AttemptOwner this_process();

}  // namespace vsglbench
