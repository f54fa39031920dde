// How far a sweep is, from its files alone.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sweep/attempt.h"
#include "sweep/plan.h"
#include "sweep/shard_folder.h"

namespace vsglbench {

//   done     measured, and on the disk
//   running  a task works at it, with signs of life
//   failed   the last task ended without its being done, or what it left is damaged
//   missing  no task has begun
enum class ShardState { done, running, failed, missing };
std::string_view name(ShardState state);

struct ShardStatus {
  size_t shard = 0;
  ShardState state = ShardState::missing;
  std::string why;  // of failed; of running, where; of done, why a task that came after was in vain
  // Sound ones: those of the class of devices that most shards were measured on, then those of others; of
  // each class the first done first.
  std::vector<FinishedShard> folders;
  size_t attempts = 0;
};

struct SweepStatus {
  SweepPlan plan;
  std::vector<ShardStatus> shards;  // of all, by number
  // By the time that a case took in the shards that are done, shared out among the tasks that run; nothing
  // before one is done.
  std::optional<double> seconds_left;

  size_t count(ShardState state) const;
  ShardCounts cases() const;  // of the shards that are done
  // Those to be run again: neither done nor running. `require`: nor done on a device that is_required().
  std::vector<size_t> open(const std::string& require = "") const;
  // 0 all done; 1 a case failed; 5 something is open.
  int exit_code() const;
};

SweepStatus status_of(const std::filesystem::path& sweep, double silent_s = kSilent_s);

std::string status_text(const SweepStatus& status);
Json to_json(const SweepStatus& status);

}  // namespace vsglbench
