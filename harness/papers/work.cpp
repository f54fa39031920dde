#include "papers/work.h"

#include <algorithm>

#include "base/child.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "gpu/shader_compiler.h"
#include "method/registry.h"
#include "report/environment.h"
#include "run/code_size.h"
#include "run/config.h"
#include "run/runner.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr const char* kMadeFile = "made.json";

// What decides a result that is no report: as ReportStore tells whether a run is the same.
Json identity(const WorkOptions& options, Json of) {
  return {{"of", std::move(of)},
          {"git", {{"commit", build_git().commit}, {"dirty", build_git().dirty}}},
          {"kernels", kernel_sources_hash()},
          {"device", options.device},
          {"assets", !assets_directory(options.assets).empty()}};
}

// The first key of a resolved config that differs from another one's; empty: they are the same.
std::string differing_key(const Json& a, const Json& b) {
  for (const auto& item : a.items()) {
    if (!b.contains(item.key()) || b.at(item.key()) != item.value()) return item.key();
  }
  for (const auto& item : b.items()) {
    if (!a.contains(item.key())) return item.key();
  }
  return "";
}

// The result that lies there, if it is the one that is wanted; with --as-is whatever programme made it.
std::optional<Json> made_before(const fs::path& folder, const Json& wanted, const WorkOptions& options) {
  std::error_code ec;
  if (options.force || !fs::exists(folder / kMadeFile, ec)) return std::nullopt;
  try {
    const Json made = JsonDocument::load(folder / kMadeFile, ErrorKind::output).root();
    const Json& id = made.at("identity");
    if (id == wanted || (options.as_is && id.at("of") == wanted.at("of"))) return made.at("result");
    if (options.as_is)
      log_warning("{}: is of another config than it is now; it is made anew", (folder / kMadeFile).string());
  } catch (const std::exception& e) {
    log_warning("{}: {}; it is made anew", (folder / kMadeFile).string(), e.what());
  }
  return std::nullopt;
}

// A whole report of this experiment as it is now, at this scale, whatever programme and device made it.
std::optional<Report> complete_at(const fs::path& folder, const Json& config) {
  std::error_code ec;
  if (!fs::exists(folder / "report.json", ec)) return std::nullopt;
  Report report = read_report_at(folder);
  const std::string other = differing_key(config, report.config);
  if (!other.empty())
    log_warning("{}: its config differs from {} as it is now in '{}'; it is measured anew",
                (folder / "report.json").string(), config.value("name", ""), other);
  return other.empty() && report.complete ? std::optional(std::move(report)) : std::nullopt;
}

void keep(const fs::path& folder, const Json& id, const Json& result) {
  write_text(folder / kMadeFile, Json({{"identity", id}, {"result", result}}).dump(1) + "\n");
}

std::vector<LightsResult> lights_from(const Json& json) {
  std::vector<LightsResult> out;
  for (const Json& item : json) from_json(item, &out.emplace_back());
  return out;
}

// Whether the pictures and lists that were drawn still lie there.
bool all_there(const std::vector<LightsResult>& drawn, const fs::path& folder) {
  std::error_code ec;
  for (const LightsResult& r : drawn) {
    if (r.status != Status::ok || r.folder.empty()) continue;
    for (const char* file : {"rsm.png", "scene.png", "lights.json"})
      if (!fs::exists(folder / r.folder / file, ec)) return false;
  }
  return true;
}

bool all_there(const DrawnFigure& drawn, const fs::path& folder) {
  std::error_code ec;
  return std::ranges::all_of(drawn.paths,
                             [&](const fs::path& path) { return fs::exists(folder / path.filename(), ec); });
}

// In a process of its own, which may open a device.
Json measure_code_sizes(const std::string& device) {
  Child child([&](const ToParent& parent) {
    Device opened({.select = device});
    Json sizes = Json::array();
    for (const MethodInfo* method : all_methods()) {
      if (method->refused.empty()) sizes.push_back(to_json(code_size(opened, method->name)));
    }
    const DeviceInfo& d = opened.info();
    parent.send(
        {{"device",
          {{"name", d.name}, {"type", d.type}, {"driver", d.driver}, {"driver_version", d.driver_version}}},
         {"sizes", sizes}});
  });
  constexpr double kSilence = 600;
  const auto sizes = child.receive(kSilence);
  if (!sizes) throw fail(ErrorKind::case_failed, "counting code {}", child.how_it_ended());
  return *sizes;
}

}  // namespace

const Work<Report>& PapersWork::run(const std::string& config) {
  const auto known = runs_.find(config);
  if (known != runs_.end()) return known->second;
  const fs::path where = folder(config, "");
  const Json now = load_config(config_path(config), Json::object(), options_.scale).resolved;
  if (auto report = options_.as_is ? complete_at(where, now) : std::nullopt)
    return runs_.emplace(config, Work<Report>{std::move(*report), where}).first->second;
  RunOptions options{.config = config_path(config),
                     .out = where,
                     .assets = options_.assets,
                     .scale = options_.scale,
                     .device = options_.device,
                     .force = options_.force,
                     .keep_complete = !options_.force,
                     .argv = options_.argv};
  return runs_.emplace(config, Work<Report>{run_config(options).report, where}).first->second;
}

const Work<std::vector<LightsResult>>& PapersWork::lights(const std::string& config,
                                                          const std::vector<std::string>& cases,
                                                          uint32_t seed) {
  const std::string key = fmt::format("{}-lights {} {}", config, seed, fmt::join(cases, " "));
  const auto known = lights_.find(key);
  if (known != lights_.end()) return known->second;
  const fs::path where = folder(config, "-lights");
  const Json id = identity(
      options_, {load_config(config_path(config), Json::object(), options_.scale).resolved, cases, seed});
  std::vector<LightsResult> results;
  const auto made = made_before(where, id, options_);
  if (made) results = lights_from(*made);
  if (!made || (!options_.as_is && !all_there(results, where))) {
    results = run_lights({.config = config_path(config),
                          .scale = options_.scale,
                          .out = where,
                          .assets = options_.assets,
                          .cases = cases,
                          .device = options_.device,
                          .seed = seed,
                          .seeds = kSeeds,
                          .argv = options_.argv});
    Json told = Json::array();
    for (const LightsResult& r : results) told.push_back(to_json(r));
    keep(where, id, told);
  }
  return lights_.emplace(key, Work<std::vector<LightsResult>>{std::move(results), where}).first->second;
}

const Work<DrawnFigure>& PapersWork::figure(const std::string& config, uint32_t width, uint32_t height) {
  const auto known = figures_.find(config);
  if (known != figures_.end()) return known->second;
  const fs::path where = folder(config, "");
  const Json figure = load_figure_config(config_path(config), width, height);
  const Json id = identity(options_, figure);
  DrawnFigure drawn;
  const auto made = made_before(where, id, options_);
  if (made) from_json(*made, &drawn);
  if (!made || (!options_.as_is && !all_there(drawn, where))) {
    ensure_writable_directory(fs::absolute(where));
    drawn = draw_figure({.config = figure,
                         .assets = assets_directory(options_.assets),
                         .folder = where,
                         .device = options_.device});
    keep(where, id, to_json(drawn));
  }
  return figures_.emplace(config, Work<DrawnFigure>{std::move(drawn), where}).first->second;
}

const Json& PapersWork::code_sizes() {
  if (code_sizes_) return *code_sizes_;
  const fs::path where = folder("code-size", "");
  const Json id = identity(options_, "code-size");
  code_sizes_ = made_before(where, id, options_);
  if (!code_sizes_) {
    code_sizes_ = measure_code_sizes(options_.device);
    keep(where, id, *code_sizes_);
  }
  return *code_sizes_;
}

}  // namespace vsglbench
