#include <unistd.h>

#include <algorithm>
#include <set>

#include "base/file.h"
#include "sweep/merge.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// A second name of the file, or a copy where the file system has no such thing.
void place(const fs::path& from, const fs::path& to) {
  std::error_code ec;
  if (fs::equivalent(from, to, ec)) return;
  write_atomically(to, [&](const fs::path& temporary) {
    fs::create_hard_link(from, temporary, ec);
    if (ec) fs::copy_file(from, temporary, fs::copy_options::overwrite_existing);
  });
}

// Where a shard's picture lies in the merged folder; nothing where another block's lies there already. Each
// block of a scene has a contact sheet of its own: the first one's keeps its name.
std::optional<fs::path> name_of(const fs::path& relative, size_t shard, const std::set<fs::path>& taken) {
  if (!taken.contains(relative)) return relative;
  const std::string name = relative.filename().string();
  if (!name.starts_with("contact")) return std::nullopt;
  return relative.parent_path() / fmt::format("shard-{}-{}", shard_name(shard), name);
}

void place_pictures(const MergedClass& c) {
  std::set<fs::path> taken;
  for (const MergedShard& shard : c.shards) {
    std::error_code ec;
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(shard.folder / "images", ec))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
      const auto name = name_of(file.lexically_relative(shard.folder), shard.shard, taken);
      if (!name) continue;
      place(file, c.folder / *name);
      taken.insert(*name);
    }
  }
}

Json drift_json(const NodeDrift& d) {
  Json out = {{"scene", d.scene},
              {"anchor", d.anchor},
              {"blocks", d.blocks},
              {"shard", d.farthest.shard},
              {"on", d.farthest.where},
              {"first_shard", d.first.shard},
              {"first_on", d.first.where},
              {"ratio", d.ratio.value},
              {"ratio_ci95", {d.ratio.ci95.lo, d.ratio.ci95.hi}},
              {"beyond_noise", d.beyond_noise()}};
  if (d.noise) out["noise_floor"] = *d.noise;
  return out;
}

Json class_json(const MergedClass& c) {
  Json shards = Json::array(), duplicates = Json::array(), drift = Json::array();
  const auto told = [](const MergedShard& s) {
    return Json{{"shard", s.shard},
                {"folder", "shards/" + s.folder.filename().string()},
                {"host", s.host.host},
                {"node", s.host.node},
                {"uuid", s.host.uuid}};
  };
  for (const MergedShard& s : c.shards) shards.push_back(told(s));
  for (const MergedShard& s : c.duplicates) duplicates.push_back(told(s));
  for (const NodeDrift& d : c.drift) drift.push_back(drift_json(d));
  return {{"device", part_to_json(c.report.device)},
          {"folder", c.folder.filename().string()},
          {"shards", shards},
          {"duplicates", duplicates},
          {"failed", c.failed()},
          {"missing", c.missing},
          {"drift", drift}};
}

}  // namespace

void write_merged(const fs::path& sweep, const MergeOutcome& outcome) {
  Json classes = Json::array(), missing = Json::array();
  for (const MergedClass& c : outcome.classes) {
    place_pictures(c);
    write_report(c.folder / "report.json", c.report);
    classes.push_back(class_json(c));
  }
  for (const ShardStatus& s : outcome.status.shards)
    if (s.folders.empty())
      missing.push_back({{"shard", s.shard}, {"state", std::string(name(s.state))}, {"why", s.why}});
  const Json json = {{"schema", "vsglbench.sweep-merge/1"},
                     {"plan", outcome.status.plan.hash()},
                     {"classes", classes},
                     {"missing", missing}};
  write_text(sweep / "merged" / "merge.json", json.dump(1) + "\n");
}

}  // namespace vsglbench
