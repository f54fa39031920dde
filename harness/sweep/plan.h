// A sweep that is too large for one machine: which case belongs to which shard, and what all shards must have
// in common. DIR/plan.json, vsglbench.sweep/1, described by plan.schema.json.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "report/report.h"
#include "run/runner.h"

namespace vsglbench {

inline constexpr const char* kSweepSchema = "vsglbench.sweep/1";

// What one task measures: a plain run of these cases of one scene.
struct Shard {
  std::string scene;               // as the config writes it, "sponza:B_author_aisle"
  std::vector<std::string> cases;  // ids in the config's order, the anchor first
  // The case that every block of a scene measures, with its A/A twin; empty: the scene is one shard.
  std::string anchor;
};

struct SweepPlan {
  std::string created;
  std::filesystem::path folder;  // in which it was made: a config's paths may be relative to it
  RunOptions run;                // config, assets, only, set, scale and scenes
  std::string config_hash;       // of the config's text and of all that it resolves to
  Json config;                   // resolved, as a report has it
  GitState git;
  std::string kernels;                         // of kernels and plugins together, as a report has it
  std::string kernel_sources;                  // of the kernels alone
  std::map<std::string, std::string> plugins;  // hash of each method's
  std::string shards_by;
  std::vector<Shard> shards;

  std::vector<std::string> scenes() const;    // each once, in the order of the shards
  std::vector<std::string> case_ids() const;  // each once, in the config's order
  size_t measurements() const;                // an anchor counts in each of its blocks
  // Of all that decides what is measured; not of when and where the plan was made.
  std::string hash() const;
};

// `shards_by`: "scene", or "block:N": a scene of more than N cases is split into blocks of at most N, beside
// the anchor, the scene's first case. Throws Error(usage) for anything else, and as load_config().
SweepPlan make_plan(const RunOptions& run, const std::string& shards_by);

// Throws Error(config) that names what differs when config, kernels, plugins or programme are no longer those
// of the plan.
void check_unchanged(const SweepPlan& plan);

// The globs of `run --only` that take these ids and no others.
std::vector<std::string> exact_globs(const std::vector<std::string>& ids);

Json to_json(const SweepPlan& plan);
// Throws Error(config) with file and line for what disobeys the schema, and where there is none.
SweepPlan read_plan(const std::filesystem::path& sweep);
// Creates the folder. The same plan once more is left as it is; another one there is Error(output).
void write_plan(const std::filesystem::path& sweep, const SweepPlan& plan);

}  // namespace vsglbench
