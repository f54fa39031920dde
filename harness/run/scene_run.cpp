#include "run/scene_run.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "measure/stopwatch.h"
#include "report/noise.h"
#include "run/memory.h"
#include "run/references.h"
#include "run/scene_images.h"
#include "run/scene_pdfs.h"
#include "run/visibility_tracer.h"

namespace vsglbench {
namespace {

// What whole frames need beside the device: the scene in the ray tracer.
struct GroundTruth {
  GroundTruth(const Scene& scene, const Config& config, WallTime* wall)
      : tracer(timed_tracer(scene, wall)), references(scene, config, wall), visibility(tracer, wall) {}
  Tracer tracer;
  References references;
  VisibilityTracer visibility;

 private:
  static Tracer timed_tracer(const Scene& scene, WallTime* wall) {
    struct Timer {
      WallTime* wall;
      Stopwatch watch;
      ~Timer() { wall->references_s += watch.seconds(); }
    } timer{wall, {}};
    return Tracer(scene);
  }
};

// One scene on the device and in the ray tracer, and its cases.
class SceneRun {
 public:
  SceneRun(Device& device, KernelLibrary& kernels, const Scene& scene, const Config& config,
           const SceneReport& report, const SceneOutcome& earlier, const SceneRunOptions& options,
           SceneObserver& observer, WallTime* wall);

  void run(const std::vector<Case>& cases);

 private:
  CaseRun& open(const Case& c);
  CaseInput input_of(CaseRun& run);
  void measure(const std::string& label);
  void add_twin();
  template <class Frame>
  void every_case(Progress& progress, const Frame& frame);
  void conclude_finished();
  void conclude(CaseRun& run);
  void pair_twin();
  void draw_sheet();
  void harness_works(const std::string& what) { observer_.now({"", what, false}); }

  const Config& config_;
  const SceneOutcome& earlier_;
  SceneObserver& observer_;
  WallTime* wall_;
  std::optional<GroundTruth> truth_;  // for whole frames
  Stage stage_;
  ScenePdfs pdfs_;  // for generation alone
  SceneReport report_;
  SceneImages images_;
  bool wants_twin_;
  std::vector<CaseRun> runs_;  // the twin, if there is one, last
  std::vector<CaseResult> results_;
  uint64_t kept_bytes_ = 0;
  bool twin_ = false, paired_ = false;
};

SceneReport describe(const Scene& scene, const std::string& name) {
  SceneReport report;
  report.name = name;
  report.hash = scene.hash;
  report.triangles = scene.triangles.size();
  report.warnings = scene.warnings;
  report.light_flux = frustum_flux(scene.light);
  return report;
}

SceneRun::SceneRun(Device& device, KernelLibrary& kernels, const Scene& scene, const Config& config,
                   const SceneReport& report, const SceneOutcome& earlier, const SceneRunOptions& options,
                   SceneObserver& observer, WallTime* wall)
    : config_(config),
      earlier_(earlier),
      observer_(observer),
      wall_(wall),
      stage_(device, kernels, scene),
      pdfs_(stage_),
      report_(report),
      images_(options.out, earlier.cases, &report_),
      wants_twin_(options.aa) {
  if (config.measure == Measure::frame) truth_.emplace(scene, config, wall);
}

// --- opening ---

CaseInput SceneRun::input_of(CaseRun& run) {
  const Case& c = run.description();
  CaseInput input;
  if (config_.measure == Measure::generation) {
    harness_works("making the PDFs");
    input.pdfs = &pdfs_.get(c.frame);
    return input;
  }
  // A reference takes as long as it takes; when it brings the process down the case that asked for it is to
  // blame.
  observer_.now({c.id, "computing its reference", false});
  input.reference = &truth_->references.get(c);
  input.reference_info = &truth_->references.info(c);
  input.exact = [this, &run](const std::vector<LightPoint>& lights) {
    return run.rest_limit([&] { return truth_->visibility.trace(*run.frame(), lights); });
  };
  return input;
}

CaseRun& SceneRun::open(const Case& c) {
  CaseRun& run =
      runs_.emplace_back(c, config_, wall_, [this](const Activity& activity) { observer_.now(activity); });
  const auto failed = [&](ErrorKind kind, const std::string& message) { run.fail_with(kind, message); };
  guarded(
      [&] {
        require_memory(stage_.device.info(), c, kept_bytes_);
        run.open(stage_, input_of(run));
        if (!run.failed()) kept_bytes_ += kept_memory(c);
      },
      failed);
  return run;
}

// The first case that has proved sound, under another name: what the two show as a difference is noise.
void SceneRun::add_twin() {
  const auto sound = std::find_if(runs_.begin(), runs_.end(), [](const CaseRun& r) { return !r.failed(); });
  if (sound == runs_.end()) return;
  Case twin = sound->description();
  twin.id = twin_id(twin.id);
  twin_ = true;
  CaseRun& run = open(twin);
  for (uint32_t i = 0; i < config_.warmup; ++i) run.warm_up();
}

// --- measuring ---

void SceneRun::run(const std::vector<Case>& cases) {
  runs_.reserve(cases.size() + 1);  // and the twin: a case's visibility callback keeps a pointer to it
  for (const Case& c : cases) open(c);
  measure(report_.name);
  if (config_.measure == Measure::frame) draw_sheet();
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

void SceneRun::measure(const std::string& label) {
  uint64_t frames = 0;
  for (const CaseRun& run : runs_) frames += run.finished() ? 0 : run.frames_left() + config_.warmup;
  Progress progress(label, frames);
  const auto step = [](CaseRun& run) { run.step(); };
  for (uint32_t i = 0; i < config_.warmup; ++i) every_case(progress, [](CaseRun& run) { run.warm_up(); });
  every_case(progress, step);
  // A round behind the others, since a case that fails does so in its first frame.
  if (wants_twin_) add_twin();
  conclude_finished();
  const auto unfinished = [](const CaseRun& run) { return !run.finished(); };
  while (std::any_of(runs_.begin(), runs_.end(), unfinished)) {
    every_case(progress, step);
    conclude_finished();
  }
}

// --- concluding ---

// Between two rounds: what is finished is written and told at once, so that no later crash can take it.
void SceneRun::conclude_finished() {
  for (CaseRun& run : runs_) {
    if (run.finished() && !run.concluded()) conclude(run);
  }
  if (twin_ && !paired_) pair_twin();
}

void SceneRun::conclude(CaseRun& run) {
  const bool is_twin = twin_ && &run == &runs_.back();
  CaseResult result = run.result();
  if (!is_twin) {
    harness_works("writing images");
    images_.write(run, &result);
  }
  run.conclude();
  harness_works("measuring");
  if (is_twin) return;
  observer_.described(report_);
  observer_.concluded(result);
  results_.push_back(std::move(result));
}

// Nothing when either failed.
void SceneRun::pair_twin() {
  const CaseRun& twin = runs_.back();
  const auto original = std::find_if(runs_.begin(), runs_.end(), [&](const CaseRun& run) {
    return twin_id(run.description().id) == twin.description().id;
  });
  if (!original->concluded() || !twin.concluded()) return;
  paired_ = true;
  if (original->failed() || twin.failed()) return;
  observer_.paired(aa_pair(original->result(), twin.result()));
}

void SceneRun::draw_sheet() {
  std::vector<CaseResult> all = earlier_.cases;
  all.insert(all.end(), results_.begin(), results_.end());
  std::vector<Case> planned;  // of this scene, in the order of the experiment
  std::copy_if(config_.cases.begin(), config_.cases.end(), std::back_inserter(planned),
               [&](const Case& c) { return c.scene == report_.name; });
  sort_like(planned, &all);
  const auto drawn =
      std::find_if(all.begin(), all.end(), [](const CaseResult& c) { return c.images.contains("indirect"); });
  if (drawn == all.end()) return;
  harness_works("drawing the contact sheet");
  const auto shown =
      std::find_if(planned.begin(), planned.end(), [&](const Case& c) { return c.id == drawn->id; });
  images_.write_sheet(all, truth_->references.get(*shown), truth_->references.info(*shown));
  observer_.described(report_);
}

}  // namespace

std::string twin_id(const std::string& case_id) { return case_id + " (A/A twin)"; }

std::vector<CaseResult> failed_cases(const std::vector<Case>& cases, const Config& config, ErrorKind kind,
                                     const std::string& message) {
  std::vector<CaseResult> results;
  for (const Case& c : cases) {
    WallTime none;
    CaseRun run(c, config, &none);
    run.fail_with(kind, message);
    results.push_back(run.result());
  }
  return results;
}

void sort_like(const std::vector<Case>& cases, std::vector<CaseResult>* results) {
  const auto place = [&](const CaseResult& r) {
    return std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.id == r.id; });
  };
  std::stable_sort(results->begin(), results->end(),
                   [&](const CaseResult& a, const CaseResult& b) { return place(a) < place(b); });
}

void run_scene(Device& device, KernelLibrary& kernels, const std::string& name, const Config& config,
               const std::vector<Case>& cases, const SceneOutcome& earlier, const SceneRunOptions& options,
               SceneObserver& observer, WallTime* wall) {
  const auto failed = [&](ErrorKind kind, const std::string& message) {
    for (const auto& result : failed_cases(cases, config, kind, message)) observer.concluded(result);
  };
  const auto run = [&] {
    observer.now({"", "loading the scene", false});
    const Scene scene = load_scene(name, options.scenes);
    SceneReport report = describe(scene, name);
    if (earlier.scene && earlier.scene->hash != report.hash) {
      throw fail(ErrorKind::scene,
                 "{}: the scene has changed since its first cases were measured; start anew with --force",
                 name);
    }
    if (earlier.scene) report = *earlier.scene;
    log_info("{}: {} triangles", name, scene.triangles.size());
    for (const auto& warning : scene.warnings) log_warning("{}: {}", name, warning);
    observer.described(report);
    SceneRun(device, kernels, scene, config, report, earlier, options, observer, wall).run(cases);
  };
  guarded(run, failed);
}

}  // namespace vsglbench
