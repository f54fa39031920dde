#include "run/lights_run.h"

#include <algorithm>
#include <memory>

#include "base/csv.h"
#include "base/file.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/supervise.h"
#include "lights/light_pictures.h"
#include "lights/moment_pictures.h"
#include "method/registry.h"
#include "report/environment.h"
#include "report/image_labels.h"
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
  LightsResult run(const Case& c, uint32_t seed,
                   const std::function<void(const std::string&, double limit_s)>& begin);

 private:
  // A scene on the device, and the PDFs that its cases share.
  struct Place {
    Place(LightsRun& run, const std::string& name);
    std::string name;
    Scene scene;
    Stage stage;
    std::optional<ScenePdfs> pdfs;
  };
  void make(Place& place, const Case& c, LightsResult* result);
  void draw(Frame& frame, const Scene& scene, const Case& c, const LightSet& lights, LightsResult* result);
  void write_list(const Case& c, const LightSet& lights, const Scene& scene,
                  const LightsResult& result) const;
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

LightsResult LightsRun::run(const Case& c, uint32_t seed,
                            const std::function<void(const std::string&, double limit_s)>& begin) {
  LightsResult result{.id = c.id, .seed = seed};
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
    make(*place_, c, &result);
  };
  guarded(draw_it, failed);
  return result;
}

void LightsRun::make(Place& place, const Case& c, LightsResult* result) {
  Case unshaded = c;
  unshaded.frame = without_visibility(c.frame);
  require_memory(device_.info(), unshaded);
  Frame frame(place.stage, load_method(c.method, device_.info()), c.method_parameters, unshaded.frame,
              nullptr);
  const KeptPdfs* shared = place.pdfs && frame.uses_importance() ? &place.pdfs->get(unshaded) : nullptr;
  const LightSet lights = make_lights(frame, result->seed, shared, unshaded.frame.rsm);
  result->lights = lights.count();
  result->empty = lights.empty();
  result->coverage = coverage_of(lights.shapes, lights.count(), lights.rsm, lights.rsm, lights.pdf);
  result->kernels = kernels_of(lights.shapes, lights.rsm, lights.rsm, lights.pdf);
  if (!lights.shapes.squares.empty())
    result->edges = edge_effect(lights.lights, lights.shapes.squares, lights.edges);
  if (result->seed == options_.seed) draw(frame, place.scene, c, lights, result);
}

void LightsRun::draw(Frame& frame, const Scene& scene, const Case& c, const LightSet& lights,
                     LightsResult* result) {
  result->folder = fs::path(file_name(c.scene)) / file_name(c.method) /
                   file_name(c.id.substr(c.scene.size() + c.method.size() + 2));
  const fs::path folder = out_ / result->folder;
  const auto labels = [&](const char* content) {
    Labels out = image_labels(content, scene.name, scene.hash);
    out.insert({{"case", c.id}, {"seed", fmt::format("{}", result->seed)}});
    return out;
  };
  const std::vector<std::string> captions = {
      c.id, fmt::format("seed {}, {} lights, {} without power", result->seed, result->lights, result->empty)};
  // The scratch memory is what generation left: nothing else has run since.
  if (const auto mips = read_mipmapped_rsm(frame.method_context(), lights.rsm, lights.rsm)) {
    write_png(folder / "moments.png",
              draw_moments(*mips, {scene.origin, scene.bounds_min, scene.bounds_max}, captions),
              labels("moments of the RSM, level by level"));
  }
  const auto fallback = lights.pdf.empty() ? reflectance(frame) : std::vector<float>();
  const View light = light_view(scene.light);
  write_png(folder / "rsm.png", draw_on_rsm(lights, light, fallback, result->coverage, captions),
            labels("a case's lights over the RSM"));
  write_png(folder / "scene.png", draw_in_scene(lights, camera_view_of(frame, scene), captions),
            labels("a case's lights in the scene"));
  write_list(c, lights, scene, *result);
}

void LightsRun::write_list(const Case& c, const LightSet& lights, const Scene& scene,
                           const LightsResult& result) const {
  const fs::path folder = out_ / result.folder;
  Json list = light_list(lights, scene.origin);
  std::error_code ec;
  if (options_.csv) {
    fs::remove(folder / "lights.json", ec);  // of an earlier run
    write_text(folder / "lights.csv", to_csv(list));
  } else {
    Json json = describe(c, lights, scene, result);
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
      {"seed", result.seed},
      {"kind", info_of(lights.lights.kind).name},
      {"count", result.lights},
      {"empty", result.empty}};
  if (result.coverage) json["coverage"] = coverage_json(result);
  if (result.edges) json["edges"] = to_json(*result.edges);
  return json;
}

// "" where there is nothing to be written.
std::string cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

// Value and interval, three cells.
void add(std::vector<std::string>* row, const std::optional<Ratio>& ratio) {
  row->push_back(cell(ratio ? std::optional(ratio->value) : std::nullopt));
  row->push_back(cell(ratio ? std::optional(ratio->ci95.lo) : std::nullopt));
  row->push_back(cell(ratio ? std::optional(ratio->ci95.hi) : std::nullopt));
}

std::string coverage_csv(const std::vector<LightsResult>& results) {
  std::string text =
      "case,seed,status,lights,empty,overlap,gap,pdf_overlap,pdf_gap,kernel_largest,kernel_over,lights_on_"
      "edges,lights_off_edges,"
      "edge_sigma_ratio,edge_sigma_ratio_lo,edge_sigma_ratio_hi,"
      "edge_density_ratio,edge_density_ratio_lo,edge_density_ratio_hi\n";
  for (const LightsResult& r : results) {
    const auto written = [](const auto& value) { return fmt::format("{}", value); };
    std::vector<std::string> row = {r.id, written(r.seed), written(name(r.status)), written(r.lights),
                                    written(r.empty)};
    const auto& c = r.coverage;
    for (const auto value : {&Coverage::overlap, &Coverage::gap})
      row.push_back(c ? written((*c).*value) : "");
    for (const auto value : {&Coverage::pdf_overlap, &Coverage::pdf_gap})
      row.push_back(cell(c ? (*c).*value : std::nullopt));
    for (const auto value : {&KernelStats::largest, &KernelStats::over})
      row.push_back(r.kernels ? written((*r.kernels).*value) : "");
    const EdgeEffect edges = r.edges.value_or(EdgeEffect{});
    for (const uint64_t lights : {edges.on, edges.off}) row.push_back(r.edges ? written(lights) : "");
    add(&row, edges.sigma);
    add(&row, edges.density);
    text += csv_row(row);
  }
  return text;
}

// All seeds of a case one after the other: job = case × seeds + which of them.
struct Jobs {
  const std::vector<Case>& cases;
  uint32_t seed, seeds;
  size_t count() const { return cases.size() * seeds; }
  const Case& case_of(size_t job) const { return cases[job / seeds]; }
  uint32_t seed_of(size_t job) const { return seed + static_cast<uint32_t>(job % seeds); }
};

// In the worker.
void draw_cases(const Worker<LightsResult>& worker, const Jobs& jobs, const std::vector<size_t>& left,
                const LightsOptions& options, const Config& config, const fs::path& out) {
  LightsRun run(options, config, out);
  Progress progress(config.name, left.size());
  for (const size_t job : left) {
    const Case& c = jobs.case_of(job);
    const uint32_t seed = jobs.seed_of(job);
    progress.label(jobs.seeds > 1 ? fmt::format("{}, seed {}", c.id, seed) : c.id);
    worker.done(job, run.run(c, seed, [&](const std::string& action, double limit_s) {
      worker.now({job, action, limit_s});
    }));
    progress.advance();
  }
}

}  // namespace

Json to_json(const LightsResult& result) {
  Json json = {{"id", result.id},        {"seed", result.seed},
               {"error", result.error},  {"status", static_cast<int>(result.status)},
               {"empty", result.empty},  {"folder", result.folder.string()},
               {"lights", result.lights}};
  if (result.coverage) json["coverage"] = part_to_json(*result.coverage);
  if (result.kernels) json["kernels"] = part_to_json(*result.kernels);
  if (result.edges) json["edges"] = to_json(*result.edges);
  return json;
}

void from_json(const Json& json, LightsResult* result) {
  result->id = json.at("id");
  result->seed = json.at("seed");
  result->status = json.at("status").get<Status>();
  result->error = json.at("error");
  result->folder = json.at("folder").get<std::string>();
  result->lights = json.at("lights");
  result->empty = json.at("empty");
  if (json.contains("coverage")) result->coverage = part_from_json<Coverage>(json["coverage"]);
  if (json.contains("kernels")) result->kernels = part_from_json<KernelStats>(json["kernels"]);
  if (json.contains("edges")) result->edges = edge_effect_from(json.at("edges"));
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
  if (!set.shapes.squares.empty()) {
    const TexelSurfaces surfaces = surfaces_of(frame.light(), download_map(frame.rsm().maps[0]),
                                               download_map(frame.rsm().geometric_normals()));
    set.edges = footprint_edges(surfaces, set.shapes.squares);
  }
  if (uses_pdf) set.pdf = pdfs.rsm.download<float>(texels);
  return set;
}

std::vector<LightsResult> run_lights(const LightsOptions& options) {
  const Config config = load_config(options.config, Json::object(), options.scale, options.scenes);
  const std::vector<Case> cases = select_cases(config.cases, options.cases, "--case");
  const Jobs jobs{cases, options.seed, options.seeds};
  const fs::path out =
      fs::absolute(options.out.empty() ? fs::path("reports") / "out" / config.name / "lights" : options.out);
  ensure_writable_directory(out);
  std::vector<LightsResult> results;
  const auto take = [&](const LightsResult& result) { results.push_back(result); };
  supervise<LightsResult>(
      {.name = config.name,
       .jobs = jobs.count(),
       .work = [&](const Worker<LightsResult>& worker,
                   const std::vector<size_t>& left) { draw_cases(worker, jobs, left, options, config, out); },
       .told = take,
       .lost =
           [&](size_t job, const End& end) {
             if (end.kind == ErrorKind::device && results.empty()) throw Error(end.kind, end.how);
             take({.id = jobs.case_of(job).id,
                   .seed = jobs.seed_of(job),
                   .status = Status::failed,
                   .error = one_line(end.message())});
           },
       .died =
           [&](const End& end) {
             log_warning("{}: {}", end.task.job ? jobs.case_of(*end.task.job).id : config.name,
                         end.message());
           }});
  write_text(out / "coverage.csv", coverage_csv(results));
  return results;
}

}  // namespace vsglbench
