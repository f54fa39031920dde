#include "run/lights_run.h"

#include <algorithm>
#include <memory>

#include "base/csv.h"
#include "base/file.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/supervise.h"
#include "lights/light_pictures.h"
#include "method/registry.h"
#include "report/environment.h"
#include "run/case_run.h"
#include "run/memory.h"
#include "run/runner.h"
#include "run/scene_images.h"
#include "scene/scene_file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// Visibility has no say in where the lights are.
FrameParameters without_visibility(FrameParameters parameters) {
  parameters.visibility = Visibility::none;
  return parameters;
}

// What stands in for the PDF of a method that uses none: the RSM's diffuse reflectance.
std::vector<float> reflectance(const Frame& frame) {
  std::vector<float> out;
  for (const glm::vec4& texel : download_map(frame.rsm().maps[3])) out.push_back(luminance(glm::vec3(texel)));
  return out;
}

CameraView camera_view_of(Frame& frame, const Scene& scene) {
  return {camera_view(scene.camera, frame.camera().width, frame.camera().height), frame.render_direct(),
          download_map(frame.gbuffer().maps[0]), download_map(frame.gbuffer().maps[1])};
}

// Of a case's list of lights: as columns of coverage.csv.
Json coverage_json(const LightsResult& result) {
  Json json = part_to_json(*result.coverage);
  if (result.kernels)
    json.update({{"kernel_largest", result.kernels->largest}, {"kernel_over", result.kernels->over}});
  return json;
}

// In the worker: the device, and the scene at hand.
class LightsRun {
 public:
  LightsRun(const LightsOptions& options, const Config& config, const fs::path& out)
      : options_(options),
        config_(config),
        out_(out),
        device_({.select = options.device}),
        kernels_(device_) {}

  // Cases of one scene come one after the other. `begin` is called before each action that may take long.
  LightsResult run(const Case& c, const std::function<void(const std::string&, double limit_s)>& begin);

 private:
  // A scene on the device, and the PDFs that its cases share.
  struct Place {
    Place(LightsRun& run, const std::string& name);
    std::string name;
    Scene scene;
    Stage stage;
    std::optional<ScenePdfs> pdfs;
  };
  void draw(Place& place, const Case& c, LightsResult* result);
  Json describe(const Case& c, const LightSet& lights, const Scene& scene, const LightsResult& result) const;
  const LightsOptions& options_;
  const Config& config_;
  const fs::path out_;
  Device device_;
  KernelLibrary kernels_;
  std::unique_ptr<Place> place_;
};

LightsRun::Place::Place(LightsRun& run, const std::string& scene_name)
    : name(scene_name),
      scene(load_scene(name, {data_root() / "scenes", assets_directory(run.options_.assets)})),
      stage(run.device_, run.kernels_, scene) {
  if (run.config_.measure == Measure::generation) pdfs.emplace(stage);
}

LightsResult LightsRun::run(const Case& c,
                            const std::function<void(const std::string&, double limit_s)>& begin) {
  LightsResult result{.id = c.id};
  const auto failed = [&](ErrorKind kind, const std::string& message) {
    result.status = kind == ErrorKind::asset_missing ? Status::skipped : Status::failed;
    result.error = message;
  };
  const auto draw_it = [&] {
    if (!place_ || place_->name != c.scene) {
      begin("loading the scene", kNoLimit);
      place_.reset();
      place_ = std::make_unique<Place>(*this, c.scene);
    }
    begin("drawing its lights", config_.time_limit_s);
    draw(*place_, c, &result);
  };
  guarded(draw_it, failed);
  return result;
}

void LightsRun::draw(Place& place, const Case& c, LightsResult* result) {
  Case unshaded = c;
  unshaded.frame = without_visibility(c.frame);
  require_memory(device_.info(), unshaded);
  Frame frame(place.stage, load_method(c.method, device_.info()), c.method_parameters, unshaded.frame,
              nullptr);
  const KeptPdfs* shared = place.pdfs && frame.uses_importance() ? &place.pdfs->get(unshaded) : nullptr;
  const LightSet lights = make_lights(frame, options_.seed, shared, unshaded.frame.rsm);
  result->lights = lights.count();
  result->empty = lights.empty();
  result->coverage = coverage_of(lights.shapes, lights.count(), lights.rsm, lights.rsm, lights.pdf);
  result->kernels = kernels_of(lights.shapes, lights.rsm, lights.rsm, lights.pdf);

  const Scene& scene = place.scene;
  result->folder = fs::path(file_name(c.scene)) / file_name(c.method) /
                   file_name(c.id.substr(c.scene.size() + c.method.size() + 2));
  const fs::path folder = out_ / result->folder;
  const std::vector<std::string> captions = {c.id, fmt::format("seed {}, {} lights, {} without power",
                                                               options_.seed, result->lights, result->empty)};
  const auto fallback = lights.pdf.empty() ? reflectance(frame) : std::vector<float>();
  const View light = light_view(scene.light);
  write_png(folder / "rsm.png", draw_on_rsm(lights, light, fallback, result->coverage, captions));
  write_png(folder / "scene.png", draw_in_scene(lights, camera_view_of(frame, scene), captions));
  Json list = light_list(lights, scene.origin);
  std::error_code ec;
  if (options_.csv) {
    fs::remove(folder / "lights.json", ec);  // of an earlier run
    write_text(folder / "lights.csv", to_csv(list));
  } else {
    Json json = describe(c, lights, scene, *result);
    json["lights"] = std::move(list);
    fs::remove(folder / "lights.csv", ec);
    write_text(folder / "lights.json", json.dump(1) + "\n");
  }
}

Json LightsRun::describe(const Case& c, const LightSet& lights, const Scene& scene,
                         const LightsResult& result) const {
  const DeviceInfo& d = device_.info();
  Json json = {
      {"schema", "vsglbench.lights/2"},
      {"created", utc_now()},
      {"argv", options_.argv},
      {"git", {{"commit", build_git().commit}, {"dirty", build_git().dirty}}},
      {"device",
       {{"name", d.name}, {"type", d.type}, {"driver", d.driver}, {"driver_version", d.driver_version}}},
      {"config", config_.resolved},
      {"case", c.id},
      {"scene", {{"name", c.scene}, {"hash", scene.hash}}},
      {"method", c.method},
      {"parameters", c.parameters},
      {"seed", options_.seed},
      {"kind", info_of(lights.lights.kind).name},
      {"count", result.lights},
      {"empty", result.empty}};
  if (result.coverage) json["coverage"] = coverage_json(result);
  return json;
}

// "" where there is nothing to be written.
std::string cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string coverage_csv(const std::vector<LightsResult>& results, uint32_t seed) {
  std::string text =
      "case,seed,status,lights,empty,overlap,gap,pdf_overlap,pdf_gap,kernel_largest,kernel_over\n";
  for (const LightsResult& r : results) {
    const auto& c = r.coverage;
    const auto of = [&](double Coverage::*value) { return c ? std::optional((*c).*value) : std::nullopt; };
    const auto kernel = [&](double KernelStats::*value) {
      return r.kernels ? std::optional((*r.kernels).*value) : std::nullopt;
    };
    text += csv_row(r.id, seed, name(r.status), r.lights, r.empty, cell(of(&Coverage::overlap)),
                    cell(of(&Coverage::gap)), cell(c ? c->pdf_overlap : std::nullopt),
                    cell(c ? c->pdf_gap : std::nullopt), cell(kernel(&KernelStats::largest)),
                    cell(kernel(&KernelStats::over)));
  }
  return text;
}

// In the worker.
void draw_cases(const Worker<LightsResult>& worker, const std::vector<Case>& cases,
                const std::vector<size_t>& left, const LightsOptions& options, const Config& config,
                const fs::path& out) {
  LightsRun run(options, config, out);
  Progress progress(config.name, left.size());
  for (const size_t job : left) {
    progress.label(cases[job].id);
    worker.done(job, run.run(cases[job], [&](const std::string& action, double limit_s) {
      worker.now({job, action, limit_s});
    }));
    progress.advance();
  }
}

}  // namespace

Json to_json(const LightsResult& result) {
  Json json = {{"id", result.id},         {"status", static_cast<int>(result.status)},
               {"error", result.error},   {"folder", result.folder.string()},
               {"lights", result.lights}, {"empty", result.empty}};
  if (result.coverage) json["coverage"] = part_to_json(*result.coverage);
  if (result.kernels) json["kernels"] = part_to_json(*result.kernels);
  return json;
}

void from_json(const Json& json, LightsResult* result) {
  result->id = json.at("id");
  result->status = json.at("status").get<Status>();
  result->error = json.at("error");
  result->folder = json.at("folder").get<std::string>();
  result->lights = json.at("lights");
  result->empty = json.at("empty");
  if (json.contains("coverage")) result->coverage = part_from_json<Coverage>(json["coverage"]);
  if (json.contains("kernels")) result->kernels = part_from_json<KernelStats>(json["kernels"]);
}

LightSet make_lights(Frame& frame, uint32_t seed, const KeptPdfs* shared, uint32_t rsm) {
  frame.render_direct();  // draws the halves
  LightSet set;
  set.rsm = rsm;
  const uint64_t texels = uint64_t(rsm) * rsm;
  const bool uses_pdf = frame.uses_importance();
  KeptPdfs own;
  if (uses_pdf && !shared) own = frame.prepare(seed);
  const KeptPdfs& pdfs = shared ? *shared : own;
  frame.generate_only(seed, pdfs);
  if (const auto bad = frame.results().bad_values()) throw fail(ErrorKind::case_failed, "{}", bad->message());
  set.lights = frame.results().lights();
  set.shapes = read_shapes(frame.light_shapes(), set.count(), texels);
  if (uses_pdf) set.pdf = pdfs.rsm.download<float>(texels);
  return set;
}

std::vector<LightsResult> run_lights(const LightsOptions& options) {
  const Config config = load_config(options.config, Json::object(), options.scale);
  const std::vector<Case> cases = select_cases(config.cases, options.cases, "--case");
  const fs::path out =
      fs::absolute(options.out.empty() ? fs::path("reports") / "out" / config.name / "lights" : options.out);
  ensure_writable_directory(out);
  std::vector<LightsResult> results;
  const auto take = [&](const LightsResult& result) { results.push_back(result); };
  supervise<LightsResult>(
      {.name = config.name,
       .jobs = cases.size(),
       .work =
           [&](const Worker<LightsResult>& worker, const std::vector<size_t>& left) {
             draw_cases(worker, cases, left, options, config, out);
           },
       .told = take,
       .lost =
           [&](size_t job, const End& end) {
             if (end.kind == ErrorKind::device && results.empty()) throw Error(end.kind, end.how);
             take({.id = cases[job].id, .status = Status::failed, .error = one_line(end.message())});
           },
       .died =
           [&](const End& end) {
             log_warning("{}: {}", end.task.job ? cases[*end.task.job].id : config.name, end.message());
           }});
  write_text(out / "coverage.csv", coverage_csv(results, options.seed));
  return results;
}

}  // namespace vsglbench
