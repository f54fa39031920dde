#include "sweep/status.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/printable.h"
#include "base/progress.h"
#include "sweep/device_choice.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

ShardStatus shard_status(const SweepFolder& folder, size_t shard, std::vector<FinishedShard> folders,
                         double silent_s) {
  ShardStatus s{.shard = shard};
  const std::vector<Attempt> attempts = attempts_in(folder.attempts(shard), silent_s);
  s.attempts = attempts.size();
  std::string unsound;
  for (FinishedShard& f : folders) {
    if (f.problem.empty())
      s.folders.push_back(std::move(f));
    else if (unsound.empty())
      unsound = f.folder.filename().string() + ": " + f.problem;
  }
  // A second task may work at a shard that is done, on another device.
  if (!attempts.empty() && attempts.back().alive) {
    s.state = ShardState::running;
    s.why = attempts.back().told();
  } else if (!s.folders.empty()) {
    s.state = ShardState::done;
    if (!attempts.empty() && attempts.back().failed()) s.why = attempts.back().told();  // once more, in vain
  } else if (!unsound.empty()) {
    s.state = ShardState::failed;
    s.why = unsound;
  } else if (!attempts.empty()) {
    s.state = ShardState::failed;
    s.why = attempts.back().end && attempts.back().end->done ? "what it measured is gone"
                                                             : attempts.back().told();
  }
  return s;
}

// Counts are of one class of devices, as a merged report is, where it has the shard.
void put_first_the_class_of_most(std::vector<ShardStatus>* shards) {
  std::map<std::string, size_t> counts;
  for (const ShardStatus& s : *shards) {
    std::set<std::string> classes;
    for (const FinishedShard& f : s.folders) classes.insert(device_class(f.record.device));
    for (const std::string& name : classes) ++counts[name];
  }
  const auto most = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
  if (most == counts.end()) return;
  for (ShardStatus& s : *shards)
    std::ranges::stable_partition(
        s.folders, [&](const FinishedShard& f) { return device_class(f.record.device) == most->first; });
}

std::optional<double> seconds_left(const SweepStatus& status) {
  double seconds = 0, measured = 0, open = 0;
  size_t running = 0;
  for (const ShardStatus& s : status.shards) {
    const size_t cases = status.plan.shards[s.shard].cases.size();
    if (s.state == ShardState::done) {
      seconds += s.folders.front().record.seconds;
      measured += static_cast<double>(cases);
    } else {
      open += static_cast<double>(cases);
    }
    running += s.state == ShardState::running;
  }
  if (measured == 0) return std::nullopt;
  return seconds / measured * open / static_cast<double>(std::max<size_t>(running, 1));
}

// A line of each class of devices that shards were measured on, where there are several.
std::string classes_text(const SweepStatus& status) {
  std::map<std::string, std::vector<std::string>> shards;  // by class
  for (const ShardStatus& s : status.shards)
    for (const FinishedShard& f : s.folders)
      shards[class_text(f.record.device)].push_back(f.folder.filename().string());
  if (shards.size() < 2) return "";
  std::string text;
  for (const auto& [name, folders] : shards) {
    const std::string which = folders.size() > 8 ? "" : fmt::format(": {}", fmt::join(folders, " "));
    text += fmt::format("  {} on {}{}\n", folders.size(), printable(name), which);
  }
  return text;
}

}  // namespace

std::string_view name(ShardState state) {
  switch (state) {
    case ShardState::done:
      return "done";
    case ShardState::running:
      return "running";
    case ShardState::failed:
      return "failed";
    case ShardState::missing:
      return "missing";
  }
  return "";
}

size_t SweepStatus::count(ShardState state) const {
  return static_cast<size_t>(std::ranges::count(shards, state, &ShardStatus::state));
}

ShardCounts SweepStatus::cases() const {
  ShardCounts sum;
  for (const ShardStatus& s : shards) {
    if (s.folders.empty()) continue;
    const ShardCounts& c = s.folders.front().record.cases;
    sum = {sum.ok + c.ok, sum.failed + c.failed, sum.skipped + c.skipped};
  }
  return sum;
}

std::vector<size_t> SweepStatus::open(const std::string& require) const {
  std::vector<size_t> out;
  for (const ShardStatus& s : shards) {
    const bool done = std::ranges::any_of(s.folders, [&](const FinishedShard& f) {
      return is_required(f.record.device.name, f.record.uuid, require);
    });
    if (!done && s.state != ShardState::running) out.push_back(s.shard);
  }
  return out;
}

int SweepStatus::exit_code() const {
  if (count(ShardState::done) < shards.size()) return 5;
  return cases().failed > 0 ? 1 : 0;
}

SweepStatus status_of(const fs::path& sweep, double silent_s) {
  SweepStatus status{read_plan(sweep), {}, {}};
  const SweepFolder folder(sweep);
  auto finished = folder.finished(status.plan.hash(), status.plan.shards.size());
  for (size_t i = 0; i < finished.size(); ++i)
    status.shards.push_back(shard_status(folder, i, std::move(finished[i]), silent_s));
  put_first_the_class_of_most(&status.shards);
  status.seconds_left = seconds_left(status);
  return status;
}

std::string status_text(const SweepStatus& s) {
  const ShardCounts cases = s.cases();
  std::string text =
      fmt::format("{}: {} shards: {} done, {} running, {} failed, {} missing",
                  printable(s.plan.config.value("name", "")), s.shards.size(), s.count(ShardState::done),
                  s.count(ShardState::running), s.count(ShardState::failed), s.count(ShardState::missing));
  if (s.seconds_left && s.count(ShardState::done) < s.shards.size())
    text += fmt::format("; about {} left", format_duration(*s.seconds_left));
  text += fmt::format("\n{} cases of {} measured, {} of them failed, {} skipped\n", cases.all(),
                      s.plan.measurements(), cases.failed, cases.skipped);
  for (const ShardStatus& shard : s.shards) {
    const std::string scene = excerpt(s.plan.shards[shard.shard].scene);
    const std::string line = fmt::format("  {} {:7} {}", shard_name(shard.shard), name(shard.state), scene);
    std::vector<std::string> notes;
    const size_t failed = shard.folders.empty() ? 0 : shard.folders.front().record.cases.failed;
    if (failed > 0)
      notes.push_back(fmt::format("{} of {} cases failed", failed, shard.folders.front().record.cases.all()));
    if (!shard.why.empty()) notes.push_back(excerpt(shard.why, 400));
    if (notes.empty() && shard.state == ShardState::done) continue;
    text += fmt::format("{}{}{}\n", line, notes.empty() ? "" : ": ", fmt::join(notes, "; "));
  }
  return text + classes_text(s);
}

Json to_json(const SweepStatus& s) {
  Json shards = Json::array();
  for (const ShardStatus& shard : s.shards) {
    Json folders = Json::array();
    for (const FinishedShard& f : shard.folders)
      folders.push_back({{"folder", "shards/" + f.folder.filename().string()}, {"host", to_json(f.record)}});
    shards.push_back({{"shard", shard.shard},
                      {"scene", s.plan.shards[shard.shard].scene},
                      {"state", std::string(name(shard.state))},
                      {"why", shard.why},
                      {"attempts", shard.attempts},
                      {"folders", folders}});
  }
  Json out = {{"schema", "vsglbench.sweep-status/1"}, {"plan", s.plan.hash()}, {"shards", shards}};
  if (s.seconds_left) out["seconds_left"] = *s.seconds_left;
  return out;
}

}  // namespace vsglbench
