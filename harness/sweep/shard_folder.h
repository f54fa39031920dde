// Where the files of a sweep lie, and what makes a shard done.
//
//   DIR/plan.json
//   DIR/attempts/00017/attempt-N.{lock,end,log}       who works, or worked, at it (attempt.h)
//   DIR/shards/.00017.attempt-N/                      what attempt N is writing: nobody reads it
//   DIR/shards/00017/                                 done: report.json, images/, host.json, attempt-*.log
//   DIR/shards/00017.attempt-N/                       done once more, by a task that another had overtaken
//
// A folder is written under its first name, synced, and renamed; rename() puts no folder in the place of one
// that holds something, so that the first to finish is the one that counts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

inline constexpr const char* kPlanFile = "plan.json";

struct ShardCounts {
  size_t ok = 0, failed = 0, skipped = 0;
  size_t all() const { return ok + failed + skipped; }
};

// host.json of a shard: where it was measured, and what status needs to know without reading the report.
struct HostRecord {
  std::string plan;  // SweepPlan::hash()
  size_t shard = 0, attempt = 0;
  std::string host, node, job;  // as AttemptOwner
  DeviceReport device;
  std::string uuid, pci;  // of the device
  std::string ended;      // UTC
  double seconds = 0;
  ShardCounts cases;
  uintmax_t report_bytes = 0;
};
Json to_json(const HostRecord& record);
HostRecord host_record_from_json(const Json& json);  // throws Json::exception

// A class of devices: what may stand in one table. Its name, driver, subgroup size and settings.
std::string device_class(const DeviceReport& device);
// "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6, subgroup 8".
std::string class_text(const DeviceReport& device);
// A folder's name for it.
std::string class_folder(const DeviceReport& device);

// One folder that holds a finished shard, or says that it does.
struct FinishedShard {
  std::filesystem::path folder;
  HostRecord record;
  std::string problem;  // why it is not; empty: it is
};

class SweepFolder {
 public:
  explicit SweepFolder(std::filesystem::path root) : root_(std::move(root)) {}
  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path attempts(size_t shard) const;
  std::filesystem::path work(size_t shard, size_t attempt) const;
  std::filesystem::path done(size_t shard) const;
  std::filesystem::path done_again(size_t shard, size_t attempt) const;

  // The folders of every shard below `count`, each shard's first one first.
  std::vector<std::vector<FinishedShard>> finished(const std::string& plan, size_t count) const;
  std::vector<FinishedShard> finished_of(const std::string& plan, size_t shard) const;

  // Makes the work of an attempt the shard: syncs and renames it. Where the shard is done already it becomes
  // another one of it. Returns its place. Throws Error(output).
  std::filesystem::path finish(size_t shard, size_t attempt) const;

 private:
  std::filesystem::path root_;
};

// "00017".
std::string shard_name(size_t shard);

// What is written there outlives a failure of the power. Of a folder: all that is in it. Throws
// Error(output).
void sync_path(const std::filesystem::path& path);

}  // namespace vsglbench
