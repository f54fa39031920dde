#include "papers/reproduce.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "measure/stopwatch.h"
#include "papers/measured_table.h"
#include "papers/sheet_rows.h"
#include "papers/trial.h"
#include "report/environment.h"
#include "report/table.h"
#include "run/case_run.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

Json to_json(const MeasuredRow& row, const std::string& machine) {
  Json json = {
      {"column", row.column}, {"name", row.name}, {"published", row.published}, {"machine", machine}};
  if (row.sum) json["sum"] = true;
  if (row.value) json.update({{"value", *row.value}, {"mean", row.mean}});
  if (row.ci95) json["ci95"] = {row.ci95->lo, row.ci95->hi};
  for (const MeasuredPass& pass : row.passes)
    json["passes"].push_back({{"name", pass.name}, {"mean_ms", pass.mean_ms}});
  return json;
}

Json to_json(const MeasuredTable& table, const Exhibit& exhibit) {
  Json rows = Json::array();
  for (const MeasuredRow& row : table.rows) {
    const auto column = std::ranges::find(exhibit.table, row.column, &PublishedColumn::head);
    rows.push_back(to_json(row, column->machine));
  }
  return {{"scene", table.scene}, {"unit", table.unit}, {"rows", rows}};
}

class ExhibitWork {
 public:
  ExhibitWork(const Exhibit& exhibit, const std::vector<PaperClaim>& claims, PapersWork* work,
              const std::string& scale)
      : exhibit_(exhibit), claims_(claims), work_(*work), scale_(scale) {}

  Json measure(const fs::path& sheets);

 private:
  template <class Action>
  void attempt(const std::string& what, const Action& action);
  void add(const std::vector<ClaimTrial>& trials);
  void take_run(const std::string& config);
  void take_lights(const std::string& config);
  void take_figure();
  void take_code_size();
  void show(const std::string& source, const fs::path& folder, const Report* report);
  void add_sheet(const fs::path& sheets);
  void note_failed(const std::vector<std::pair<std::string, std::string>>& failed);
  void note_machine(const DeviceReport& device);
  void note_machine_of_lights(const Work<std::vector<LightsResult>>& work);

  const Exhibit& exhibit_;
  const std::vector<PaperClaim>& claims_;
  PapersWork& work_;
  const std::string scale_;
  Json json_;
  std::vector<SheetRow> rows_;
};

// What a part can't do costs that part.
template <class Action>
void ExhibitWork::attempt(const std::string& what, const Action& action) {
  const auto failed = [&](ErrorKind kind, const std::string& message) {
    if (kind == ErrorKind::device) throw Error(kind, message);
    json_["problems"].push_back(what + ": " + one_line(message));
    log_warning("{}: {}: {}", exhibit_.name, what, message);
  };
  guarded(action, failed);
}

void ExhibitWork::add(const std::vector<ClaimTrial>& trials) {
  for (const ClaimTrial& t : trials) json_["trials"].push_back(vsglbench::to_json(t));
}

void ExhibitWork::note_machine(const DeviceReport& d) {
  json_["device"] = {
      {"name", d.name}, {"type", d.type}, {"driver", d.driver}, {"driver_version", d.driver_version}};
}

// Cases and why; those that failed alike are told together.
void ExhibitWork::note_failed(const std::vector<std::pair<std::string, std::string>>& failed) {
  std::vector<std::string> told;
  for (const auto& [id, why] : failed) {
    if (std::ranges::count(told, why) > 0) continue;
    told.push_back(why);
    const auto alike =
        std::ranges::count_if(failed, [&, &reason = why](const auto& f) { return f.second == reason; });
    json_["problems"].push_back(alike > 1 ? fmt::format("{} and {} more: {}", id, alike - 1, why)
                                          : id + ": " + why);
  }
}

void ExhibitWork::note_machine_of_lights(const Work<std::vector<LightsResult>>& work) {
  for (const LightsResult& r : work.result) {
    if (r.status != Status::ok || r.folder.empty()) continue;
    json_["device"] =
        JsonDocument::load(work.folder / r.folder / "lights.json", ErrorKind::output).root().at("device");
    return;
  }
}

void ExhibitWork::take_run(const std::string& config) {
  const Work<Report>& work = work_.run(config);
  const Report& report = work.result;
  note_machine(report.device);
  json_["host"] = {{"cpu", report.host.cpu}, {"cores", report.host.cores}};  // perhaps another machine's
  json_["measured"].push_back({{"config", config},
                               {"created", report.created},
                               {"commit", report.git.commit},
                               {"dirty", report.git.dirty},
                               {"wall_s", report.wall.total_s}});
  std::vector<std::pair<std::string, std::string>> failed;
  for (const CaseResult& c : report.cases) {
    if (c.status != Status::ok) failed.emplace_back(c.id, c.error ? c.error->message : "failed");
  }
  note_failed(failed);
  const std::vector<MeasuredTable> tables = tables_of(report, exhibit_);
  if (!exhibit_.table.empty() && tables.empty())
    json_["problems"].push_back(config + ": no scene has a sound case of every column of the table");
  for (const MeasuredTable& table : tables) json_["tables"].push_back(to_json(table, exhibit_));
  add(trials_of(report, exhibit_, claims_));
  if (!exhibit_.columns.empty())
    json_["reports"].push_back(
        {{"config", config}, {"markdown", markdown_table(report, {.columns = exhibit_.columns})}});
  show(config, work.folder, &report);
}

// Of all ok cases of `fis`, by what its kernels hold of the PDF.
uint32_t seed_of_largest_kernel(const Report& report) {
  double largest = 0;
  uint64_t seed = 0;
  for (const CaseResult& c : report.cases) {
    for (const SeedResult& s : c.seeds) {
      if (c.method != "fis" || !s.kernels || s.kernels->largest <= largest) continue;
      largest = s.kernels->largest;
      seed = s.seed;
    }
  }
  return static_cast<uint32_t>(seed);
}

// The light of a drawn case whose kernel holds most, and how many of all seeds hold too much.
std::string largest_kernel_note(const Work<std::vector<LightsResult>>& work, const LightsResult& drawn) {
  const Json json = JsonDocument::load(work.folder / drawn.folder / "lights.json", ErrorKind::output).root();
  double power = 0;
  const Json* largest = nullptr;
  for (const Json& light : json.at("lights")) {
    power += light.at("power").get<double>();
    if (light.contains("mass") && (!largest || light["mass"] > largest->at("mass"))) largest = &light;
  }
  if (!largest) return "";
  double over = 0;
  uint64_t lights = 0, seeds = 0;
  for (const LightsResult& r : work.result) {
    if (r.id != drawn.id || !r.kernels) continue;
    over += r.kernels->over * static_cast<double>(r.lights);
    lights += r.lights;
    ++seeds;
  }
  return fmt::format(
      "{}: in seed {} light {} of {} holds {:.3g} times 1/N of the PDF and carries {:.3g} % of the power; of "
      "the "
      "lights of {} seeds {:.0f} of {} hold more than 4/N",
      drawn.id, drawn.seed, largest->at("index").get<int>(), drawn.lights, largest->at("mass").get<double>(),
      100 * largest->at("power").get<double>() / power, seeds, over, lights);
}

void ExhibitWork::take_lights(const std::string& config) {
  const uint32_t seed =
      exhibit_.largest_kernel ? seed_of_largest_kernel(work_.run(exhibit_.runs.at(0)).result) : 0;
  const auto& work = work_.lights(config, exhibit_.light_cases, seed);
  note_machine_of_lights(work);
  for (const LightsResult& r : work.result) {
    if (!exhibit_.largest_kernel || r.status != Status::ok || r.seed != seed) continue;
    if (const std::string note = largest_kernel_note(work, r); !note.empty()) json_["notes"].push_back(note);
  }
  std::vector<std::pair<std::string, std::string>> failed;
  for (const LightsResult& r : work.result) {
    if (r.status != Status::ok) failed.emplace_back(r.id, r.error);
  }
  note_failed(failed);
  if (exhibit_.edges) add(trials_of(work.result, exhibit_));
  show(config + "-lights", work.folder, nullptr);
}

void ExhibitWork::take_figure() {
  const bool quick = scale_ == kQuickScale;
  const auto& work =
      work_.figure(exhibit_.figure, quick ? exhibit_.quick_width : 0, quick ? exhibit_.quick_height : 0);
  const Json& d = work.result.device;
  json_["device"] = d;
  add(trials_of(work.result, exhibit_));
  show(exhibit_.figure, work.folder, nullptr);
}

void ExhibitWork::take_code_size() {
  const Json& counted = work_.code_sizes();
  const Json& sizes = counted.at("sizes");
  json_["device"] = counted.at("device");
  json_["tables"].push_back(to_json(code_size_table_of(sizes, exhibit_), exhibit_));
  add(trials_of_code_size(sizes, exhibit_));
}

// Rows of the parts that are of this run, these lights or this figure; a run has a report.
void ExhibitWork::show(const std::string& source, const fs::path& folder, const Report* report) {
  std::vector<std::string> problems;
  for (const SheetPart& part : exhibit_.sheet) {
    if (part.run != source) continue;
    if (!part.files.empty()) rows_.push_back(files_of(folder, part, &problems));
    if (!report || part.images.empty()) continue;
    for (SheetRow& row : rows_of(*report, folder, part, &problems)) rows_.push_back(std::move(row));
  }
  Json& told = json_["problems"];
  for (const std::string& problem : problems) {
    if (std::find(told.begin(), told.end(), Json(problem)) == told.end()) told.push_back(problem);
  }
}

void ExhibitWork::add_sheet(const fs::path& sheets) {
  std::erase_if(rows_, [](const SheetRow& row) { return row.tiles.empty(); });
  if (rows_.empty()) return;
  const std::string file = exhibit_.name + ".png";
  write_png(sheets / file, draw_sheet(fmt::format("{} {}", exhibit_.source, exhibit_.title), rows_));
  json_["sheet"] = file;
}

Json ExhibitWork::measure(const fs::path& sheets) {
  const Stopwatch watch;
  const HostInfo host = host_info();
  json_ = {{"name", exhibit_.name},
           {"source", exhibit_.source},
           {"title", exhibit_.title},
           {"scale", scale_},
           {"command", fmt::format("vsglbench reproduce {} --scale {}", exhibit_.name, scale_)},
           {"created", utc_now()},
           {"commit", build_git().commit},
           {"dirty", build_git().dirty},
           {"host", {{"cpu", host.cpu}, {"cores", host.cores}}},
           {"measured", Json::array()},
           {"tables", Json::array()},
           {"reports", Json::array()},
           {"problems", Json::array()},
           {"trials", Json::array()}};
  if (!exhibit_.differs.empty()) json_["differs"] = exhibit_.differs;
  for (const std::string& config : exhibit_.runs) attempt(config, [&] { take_run(config); });
  for (const std::string& config : exhibit_.lights) attempt(config, [&] { take_lights(config); });
  if (!exhibit_.figure.empty()) attempt(exhibit_.figure, [&] { take_figure(); });
  if (exhibit_.code_size) attempt("code size", [&] { take_code_size(); });
  attempt("sheet", [&] { add_sheet(sheets); });
  json_["wall_s"] = watch.seconds();
  return json_;
}

}  // namespace

Json reproduce_exhibit(const Exhibit& exhibit, const std::vector<PaperClaim>& claims, PapersWork* work,
                       const std::string& scale, const fs::path& sheets) {
  return ExhibitWork(exhibit, claims, work, scale).measure(sheets);
}

}  // namespace vsglbench
