// The reports of a sweep's shards as one: DIR/merged/CLASS/report.json of each class of devices, with its
// pictures, and DIR/merged/merge.json.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sweep/node_drift.h"
#include "sweep/status.h"

namespace vsglbench {

// A shard's folder that the merge took, or left.
struct MergedShard {
  size_t shard = 0;
  std::filesystem::path folder;
  HostRecord host;
};

// All that was measured on one class of devices (device_class()).
struct MergedClass {
  Report report;  // complete: nothing is missing. Its config's `missing` lists the cases that are
  std::filesystem::path folder;
  std::vector<MergedShard> shards;
  std::vector<MergedShard> duplicates;  // of a shard that was done before: not taken
  std::vector<std::string> missing;     // ids of cases
  std::vector<NodeDrift> drift;         // of each scene that was split
  size_t failed() const;                // cases
};

struct MergeOutcome {
  SweepStatus status;
  std::vector<std::string> refused;  // one line each; then nothing was merged
  std::vector<MergedClass> classes;  // that with the fewest missing cases first
  // 0: all cases of the first class are there; 1: and some failed; 5: some are missing, or the merge was
  // refused.
  int exit_code() const;
};

// What all shards of a sweep must have in common. Asked shard by shard.
class MergeChecks {
 public:
  explicit MergeChecks(const SweepPlan& plan) : plan_(plan) {}
  // Why this report can't stand beside the others; empty: it can.
  std::string problem(size_t shard, const std::string& folder, const Report& report);

 private:
  std::string other_than_planned(size_t shard, const Report& report) const;
  std::string agree(const std::string& what, const std::string& value, const std::string& folder);
  const SweepPlan& plan_;
  std::map<std::string, std::pair<std::string, std::string>> common_;  // by what: value, first folder
};

// Depends on what lies in DIR/shards alone: the order in which it came there makes no difference, and merging
// again changes nothing. Shards that were measured from another config, kernels or programme, by other
// formulas or against other references are refused, and then nothing is written.
MergeOutcome merge_sweep(const std::filesystem::path& sweep);

// The same without a file.
MergeOutcome merged(const std::filesystem::path& sweep);
void write_merged(const std::filesystem::path& sweep, const MergeOutcome& outcome);

std::string merge_text(const MergeOutcome& outcome);

}  // namespace vsglbench
