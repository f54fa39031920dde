// One task of a sweep: a plain run of a shard's cases, in a folder of its own until it is done.
#pragma once

#include <filesystem>
#include <string>

#include "sweep/attempt.h"
#include "sweep/plan.h"
#include "sweep/shard_folder.h"

namespace vsglbench {

struct TaskOptions {
  std::string device;   // as in select_device(); empty: what the engine gave
  std::string require;  // as DeviceWish::require
  double silent_s = kSilent_s;
};

struct TaskOutcome {
  enum class What { measured, was_done, held } what = What::measured;
  std::filesystem::path folder;  // of the shard, measured now or before
  ShardCounts cases;
  Attempt holder;     // of a shard that another task works at
  int exit_code = 0;  // 1: a case failed
};

// Does nothing where the shard is done, on a device that is_required(), or another task works at it. A folder
// that says it is done and is not is moved beside the attempts. Whatever stops the task is written into the
// attempt's .end, and thrown: Error(config) when the sweep is no longer what was planned, WrongDevice. What
// the run says goes into attempt-N.log. For a process without threads and without a Vulkan device.
TaskOutcome run_shard(const std::filesystem::path& sweep, size_t shard, const TaskOptions& options);

// In a handler of a signal that ends the process: the attempt at hand ends as one that was stopped by it.
// Only kill_children() is called there; run_shard() then throws, and the caller raises the signal once more.
void stop_shard(int signal) noexcept;
int shard_stopped_by() noexcept;  // 0: none

}  // namespace vsglbench
