#include "base/file.h"
#include "sweep/plan.h"
#include "sweep/shard_folder.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

const Json& plan_schema() {
  static const Json schema =
      JsonDocument::load(data_root() / "harness" / "sweep" / "plan.schema.json", ErrorKind::config).root();
  return schema;
}

RunOptions run_from_json(const Json& json) {
  RunOptions run;
  run.config = json.at("config").get<std::string>();
  run.assets = json.at("assets").get<std::string>();
  run.only = json.at("only").get<std::vector<std::string>>();
  run.set = json.at("set").get<std::vector<std::string>>();
  run.scale = json.at("scale");
  run.scenes = {json.at("scenes").get<std::vector<std::string>>(), json.at("named_after_scene")};
  return run;
}

}  // namespace

Json to_json(const SweepPlan& plan) {
  Json shards = Json::array();
  for (const Shard& s : plan.shards) {
    shards.push_back({{"scene", s.scene}, {"cases", s.cases}});
    if (!s.anchor.empty()) shards.back()["anchor"] = s.anchor;
  }
  const RunOptions& run = plan.run;
  return {{"schema", kSweepSchema},
          {"created", plan.created},
          {"hash", plan.hash()},
          {"folder", plan.folder.string()},
          {"run",
           {{"config", run.config.string()},
            {"assets", run.assets.string()},
            {"only", run.only},
            {"set", run.set},
            {"scale", run.scale},
            {"scenes", run.scenes.scenes},
            {"named_after_scene", run.scenes.names_it}}},
          {"config_hash", plan.config_hash},
          {"config", plan.config},
          {"git", {{"commit", plan.git.commit}, {"dirty", plan.git.dirty}}},
          {"kernels", plan.kernels},
          {"kernel_sources", plan.kernel_sources},
          {"plugins", plan.plugins},
          {"shards_by", plan.shards_by},
          {"shards", shards}};
}

SweepPlan read_plan(const fs::path& sweep) {
  const fs::path path = sweep / kPlanFile;
  std::error_code ec;
  if (!fs::exists(path, ec))
    throw fail(ErrorKind::config, "{}: no sweep is planned there; vsglbench sweep plan CONFIG --out {}",
               sweep.string(), sweep.string());
  const JsonDocument doc = JsonDocument::load(path, ErrorKind::config);
  check_schema(doc, plan_schema());
  const Json& json = doc.root();
  SweepPlan plan;
  plan.created = json.at("created");
  plan.folder = json.at("folder").get<std::string>();
  plan.run = run_from_json(json.at("run"));
  plan.config_hash = json.at("config_hash");
  plan.config = json.at("config");
  plan.git = {json.at("git").at("commit"), json.at("git").at("dirty")};
  plan.kernels = json.at("kernels");
  plan.kernel_sources = json.at("kernel_sources");
  plan.plugins = json.at("plugins").get<std::map<std::string, std::string>>();
  plan.shards_by = json.at("shards_by");
  for (const Json& s : json.at("shards"))
    plan.shards.push_back(
        {s.at("scene"), s.at("cases").get<std::vector<std::string>>(), s.value("anchor", "")});
  if (plan.hash() != json.at("hash"))
    throw doc.error("/hash", "is not that of the plan: the file was edited");
  return plan;
}

void write_plan(const fs::path& sweep, const SweepPlan& plan) {
  std::error_code ec;
  if (fs::exists(sweep / kPlanFile, ec)) {
    if (read_plan(sweep).hash() == plan.hash()) return;
    throw fail(ErrorKind::output, "{}: another sweep is planned there; give another --out", sweep.string());
  }
  write_text(sweep / kPlanFile, to_json(plan).dump(1) + "\n");
}

}  // namespace vsglbench
