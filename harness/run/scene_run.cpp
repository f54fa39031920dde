#include "run/scene_run.h"

#include <algorithm>

#include "base/log.h"
#include "base/progress.h"
#include "measure/stopwatch.h"
#include "run/memory.h"
#include "run/references.h"
#include "run/scene_images.h"
#include "run/visibility_tracer.h"

namespace vsglbench {
namespace {

// One scene on the device and in the ray tracer, and its cases.
class SceneRun {
 public:
  SceneRun(Device& device, KernelLibrary& kernels, const Scene& scene, const Config& config, WallTime* wall)
      : config_(config),
        wall_(wall),
        tracer_(timed_tracer(scene, wall)),
        stage_(device, kernels, scene),
        references_(scene, config, wall),
        visibility_(tracer_, wall) {}

  void open(const std::vector<Case>& cases);
  void measure(const std::string& label, bool with_twin);
  std::optional<AaPair> take_twin();
  std::vector<CaseRun>& runs() { return runs_; }

 private:
  static Tracer timed_tracer(const Scene& scene, WallTime* wall);
  void open(const Case& c);
  void add_twin();
  template <class Frame>
  void every_case(Progress& progress, const Frame& frame);

  const Config& config_;
  WallTime* wall_;
  Tracer tracer_;
  Stage stage_;
  References references_;
  VisibilityTracer visibility_;
  std::vector<CaseRun> runs_;
  uint64_t kept_bytes_ = 0;
  bool twin_ = false;
};

Tracer SceneRun::timed_tracer(const Scene& scene, WallTime* wall) {
  struct Timer {
    WallTime* wall;
    Stopwatch watch;
    ~Timer() { wall->references_s += watch.seconds(); }
  } timer{wall, {}};
  return Tracer(scene);
}

void SceneRun::open(const std::vector<Case>& cases) {
  runs_.reserve(cases.size() + 1);  // and the twin: a case's visibility callback keeps a pointer to it
  for (const Case& c : cases) open(c);
}

void SceneRun::open(const Case& c) {
  CaseRun& run = runs_.emplace_back(c, config_, wall_);
  const auto failed = [&](const std::string& kind, const std::string& message) {
    run.fail_with(kind, message);
  };
  guarded(
      "config",
      [&] {
        require_memory(stage_.device.info(), c, kept_bytes_);
        const ReferenceResult& reference = references_.get(c);
        run.open(stage_, reference,
                 [this, &run](const auto& lights) { return visibility_.trace(*run.frame(), lights); });
        if (!run.failed()) kept_bytes_ += kept_memory(c);
      },
      failed);
}

// The first case that has proved sound, under another name: what the two show as a difference is noise.
void SceneRun::add_twin() {
  const auto sound = std::find_if(runs_.begin(), runs_.end(), [](const CaseRun& r) { return !r.failed(); });
  if (sound == runs_.end()) return;
  Case twin = sound->description();
  twin.id += " (A/A twin)";
  open(twin);
  for (uint32_t i = 0; i < config_.warmup; ++i) runs_.back().warm_up();
  twin_ = true;
}

template <class Frame>
void SceneRun::every_case(Progress& progress, const Frame& frame) {
  for (CaseRun& run : runs_) {
    if (run.finished()) continue;
    progress.label(run.description().id);
    frame(run);
    progress.advance();
  }
}

void SceneRun::measure(const std::string& label, bool with_twin) {
  uint64_t frames = 0;
  for (const CaseRun& run : runs_) frames += run.finished() ? 0 : run.frames_left() + config_.warmup;
  Progress progress(label, frames);
  for (uint32_t i = 0; i < config_.warmup; ++i) every_case(progress, [](CaseRun& run) { run.warm_up(); });
  every_case(progress, [](CaseRun& run) { run.step(); });
  if (with_twin) add_twin();  // a round behind the others, since a case that fails does so in its first frame
  const auto unfinished = [](const CaseRun& run) { return !run.finished(); };
  while (std::any_of(runs_.begin(), runs_.end(), unfinished)) {
    every_case(progress, [](CaseRun& run) { run.step(); });
  }
}

// Removes the twin. Nothing when there is none, either failed, or the device's clock saw no time pass.
std::optional<AaPair> SceneRun::take_twin() {
  if (!twin_) return std::nullopt;
  const CaseRun twin = std::move(runs_.back());
  runs_.pop_back();
  twin_ = false;
  const auto same = [&](const CaseRun& run) {
    return run.description().parameters == twin.description().parameters &&
           run.description().method == twin.description().method;
  };
  const auto original = std::find_if(runs_.begin(), runs_.end(), same);
  if (original->failed() || twin.failed()) return std::nullopt;
  const auto positive = [](const std::vector<double>& samples) {
    return std::all_of(samples.begin(), samples.end(), [](double s) { return s > 0; });
  };
  if (!positive(original->span_samples()) || !positive(twin.span_samples())) return std::nullopt;
  AaPair pair{original->description().id, twin.description().id, {}, 0};
  pair.ratio = median_ratio(original->span_samples(), twin.span_samples());
  pair.noise_floor = noise_floor(pair.ratio);
  return pair;
}

SceneReport describe(const Scene& scene, const std::string& name) {
  SceneReport report;
  report.name = name;
  report.hash = scene.hash;
  report.triangles = scene.triangles.size();
  report.warnings = scene.warnings;
  report.light_flux = frustum_flux(scene.light);
  return report;
}

void measure_scene(Device& device, KernelLibrary& kernels, const Scene& scene, const Config& config,
                   const std::vector<Case>& cases, const SceneRunOptions& options, WallTime* wall,
                   SceneOutcome* outcome) {
  SceneRun run(device, kernels, scene, config, wall);
  run.open(cases);
  run.measure(outcome->scene->name, options.aa);
  outcome->aa = run.take_twin();
  std::vector<CaseResult> results;
  for (const CaseRun& r : run.runs()) results.push_back(r.result());
  write_images(options.out, run.runs(), results, &*outcome->scene);
  outcome->cases = std::move(results);
}

}  // namespace

std::vector<CaseResult> failed_cases(const std::vector<Case>& cases, const Config& config,
                                     const std::string& kind, const std::string& message) {
  std::vector<CaseResult> results;
  for (const Case& c : cases) {
    WallTime none;
    CaseRun run(c, config, &none);
    run.fail_with(kind, message);
    results.push_back(run.result());
  }
  return results;
}

SceneOutcome run_scene(Device& device, KernelLibrary& kernels, const std::string& name, const Config& config,
                       const std::vector<Case>& cases, const SceneRunOptions& options, WallTime* wall) {
  SceneOutcome outcome;
  const auto failed = [&](const std::string& kind, const std::string& message) {
    outcome.cases = failed_cases(cases, config, kind, message);
  };
  const auto run = [&] {
    try {
      const Scene scene = load_scene(name, options.scenes);
      outcome.scene = describe(scene, name);
      log_info("{}: {} triangles", name, scene.triangles.size());
      for (const auto& warning : scene.warnings) log_warning("{}: {}", name, warning);
      measure_scene(device, kernels, scene, config, cases, options, wall, &outcome);
    } catch (const AssetMissing& e) {
      failed("asset_missing", e.what());
    }
  };
  guarded("scene", run, failed);
  return outcome;
}

}  // namespace vsglbench
