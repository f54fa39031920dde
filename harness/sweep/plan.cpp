#include "sweep/plan.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "base/file.h"
#include "base/hash.h"
#include "gpu/shader_compiler.h"
#include "method/registry.h"
#include "report/environment.h"
#include "run/case_id.h"
#include "run/overrides.h"
#include "run/sources.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// The largest number of cases of a shard; 0: all of its scene.
size_t block_size(const std::string& shards_by) {
  constexpr std::string_view kBlock = "block:";
  if (shards_by == "scene") return 0;
  size_t size = 0;
  const char *begin = shards_by.data() + std::min(kBlock.size(), shards_by.size()),
             *end = shards_by.data() + shards_by.size();
  const auto parsed = std::from_chars(begin, end, size);
  if (!shards_by.starts_with(kBlock) || parsed.ec != std::errc() || parsed.ptr != end || size == 0)
    throw fail(ErrorKind::usage, "--shards-by takes scene or block:N, such as block:50, not '{}'", shards_by);
  return size;
}

// Blocks of nearly equal size, each with the anchor in front.
std::vector<Shard> blocks_of(const std::string& scene, const std::vector<std::string>& ids, size_t size) {
  if (size == 0 || ids.size() <= size) return {{scene, ids, ""}};
  std::vector<Shard> shards;
  const size_t count = (ids.size() + size - 1) / size;
  for (size_t b = 0; b < count; ++b) {
    Shard shard{scene, {}, ids.front()};
    if (b > 0) shard.cases.push_back(shard.anchor);
    const size_t begin = b * ids.size() / count, end = (b + 1) * ids.size() / count;
    for (size_t i = begin; i < end; ++i) shard.cases.push_back(ids[i]);
    shards.push_back(std::move(shard));
  }
  return shards;
}

Config load(const RunOptions& run) {
  return load_config(run.config, parse_overrides(run.set), run.scale, run.scenes);
}

std::string hash_of(const RunOptions& run, const Config& config) {
  Hasher hasher;
  hasher.text(read_text(run.config)).text(config.resolved.dump());
  for (const Case& c : config.cases) hasher.text(c.id).text(fingerprint(c));
  return hasher.hex();
}

// Config, kernels, plugins and programme as they are now.
SweepPlan present(const RunOptions& run, const Config& config) {
  SweepPlan plan;
  plan.run = run;
  plan.config_hash = hash_of(run, config);
  plan.config = config.resolved;
  if (!run.only.empty()) plan.config["only"] = run.only;
  plan.git = build_git();
  plan.kernels = sources_hash(config);
  plan.kernel_sources = kernel_sources_hash();
  for (const Case& c : config.cases) {
    std::string& hash = plan.plugins[c.method];
    if (hash.empty()) hash = plugin_hash(find_method(c.method));
  }
  return plan;
}

}  // namespace

SweepPlan make_plan(const RunOptions& run, const std::string& shards_by) {
  const size_t size = block_size(shards_by);
  RunOptions options = run;
  options.config = fs::absolute(run.config);
  if (!run.assets.empty()) options.assets = fs::absolute(run.assets);
  const Config config = load(options);
  SweepPlan plan = present(options, config);
  plan.created = utc_now();
  plan.folder = fs::current_path();
  plan.shards_by = shards_by;
  const std::vector<Case> cases = select_cases(config.cases, run.only, "--only");
  for (const std::string& scene : config.scenes) {
    std::vector<std::string> ids;
    for (const Case& c : cases)
      if (c.scene == scene) ids.push_back(c.id);
    if (ids.empty()) continue;
    std::ranges::move(blocks_of(scene, ids, size), std::back_inserter(plan.shards));
  }
  return plan;
}

void check_unchanged(const SweepPlan& plan) {
  const SweepPlan now = present(plan.run, load(plan.run));
  const auto differs = [](const std::string& what) {
    return fail(ErrorKind::config,
                "{} since the sweep was planned; bring it back, or plan into another folder", what);
  };
  if (now.config_hash != plan.config_hash)
    throw differs(fmt::format("the config {} has changed", plan.run.config.string()));
  if (now.kernel_sources != plan.kernel_sources) throw differs("the kernels have changed");
  for (const auto& [method, hash] : plan.plugins)
    if (now.plugins.at(method) != hash) throw differs(fmt::format("the method {} has changed", method));
  if (now.git.commit != plan.git.commit || now.git.dirty != plan.git.dirty)
    throw differs(fmt::format("the programme has changed from commit {} to {}", plan.git.commit.substr(0, 7),
                              now.git.commit.substr(0, 7)));
}

std::vector<std::string> exact_globs(const std::vector<std::string>& ids) {
  std::vector<std::string> globs;
  for (const std::string& id : ids) {
    std::string& glob = globs.emplace_back();
    for (const char c : id) {
      if (std::string_view("*?[]\\").find(c) != std::string::npos) glob += '\\';
      glob += c;
    }
  }
  return globs;
}

std::vector<std::string> SweepPlan::scenes() const {
  std::vector<std::string> out;
  for (const Shard& shard : shards)
    if (out.empty() || out.back() != shard.scene) out.push_back(shard.scene);
  return out;
}

std::vector<std::string> SweepPlan::case_ids() const {
  std::vector<std::string> out;
  std::set<std::string> seen;
  for (const Shard& shard : shards)
    for (const std::string& id : shard.cases)
      if (seen.insert(id).second) out.push_back(id);
  return out;
}

size_t SweepPlan::measurements() const {
  size_t count = 0;
  for (const Shard& shard : shards) count += shard.cases.size();
  return count;
}

std::string SweepPlan::hash() const {
  Hasher hasher;
  hasher.text(config_hash).text(kernels).text(git.commit).value(git.dirty);
  for (const Shard& shard : shards) {
    hasher.text(shard.scene).text(shard.anchor);
    for (const std::string& id : shard.cases) hasher.text(id);
    hasher.value(shard.cases.size());
  }
  return hasher.hex();
}

}  // namespace vsglbench
