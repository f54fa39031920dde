#include "run/scene_run.h"

#include <algorithm>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "measure/stopwatch.h"
#include "method/registry.h"
#include "run/effect_prices.h"
#include "run/ground_truth.h"
#include "run/memory.h"
#include "run/scene_effects.h"
#include "run/scene_images.h"
#include "run/scene_motion.h"
#include "run/scene_pdfs.h"
#include "run/scene_rounds.h"
#include "scene/animation.h"

namespace vsglbench {
namespace {

// One scene on the device and in the ray tracer, and its cases.
class SceneRun {
 public:
  // `scene` is posed in its frames, and left in the first.
  SceneRun(Device& device, KernelLibrary& kernels, Scene& scene, const Config& config,
           const SceneReport& report, const SceneOutcome& earlier, const SceneRunOptions& options,
           SceneObserver& observer, WallTime* wall);

  void run(const std::vector<Case>& cases);

 private:
  CaseRun& open(const Case& c);
  CaseInput input_of(CaseRun& run);
  void look_at_all(const std::vector<Case>& cases);
  void settle(CaseRun& run);
  void warn_of_region(const Case& c);
  void look_at_motion();
  bool add_twin();
  void conclude(CaseRun& run);
  void draw_sheet();
  const Case* first_sound_case() const;
  void price();
  void harness_works(const std::string& what) { observer_.now({"", what, false}); }

  Scene& scene_;
  const Config& config_;
  const std::filesystem::path out_;
  const SceneOutcome& earlier_;
  SceneObserver& observer_;
  WallTime* wall_;
  std::optional<GroundTruth> truth_;  // for whole frames
  Stage stage_;
  SceneEffects effects_;
  SceneClocks clocks_;
  ScenePdfs pdfs_;  // for generation alone
  SceneReport report_;
  SceneImages images_;
  bool wants_twin_;
  FlipKeeper flip_;
  std::vector<CaseRun> runs_;  // the twin, if there is one, last
  std::vector<CaseResult> results_;
  uint64_t kept_bytes_ = 0;
};

SceneRun::SceneRun(Device& device, KernelLibrary& kernels, Scene& scene, const Config& config,
                   const SceneReport& report, const SceneOutcome& earlier, const SceneRunOptions& options,
                   SceneObserver& observer, WallTime* wall)
    : scene_(scene),
      config_(config),
      out_(options.out),
      earlier_(earlier),
      observer_(observer),
      wall_(wall),
      stage_(device, kernels, scene),
      effects_(scene),
      clocks_(options.device_uuid, report.clocks),
      pdfs_(stage_),
      report_(report),
      images_(options.out, has_images(earlier), &report_),
      wants_twin_(options.aa) {
  if (config.measure != Measure::frame) return;
  truth_.emplace(scene, config, wall);
  images_.trace_by(&truth_->tracer);
}

// --- opening ---

CaseInput SceneRun::input_of(CaseRun& run) {
  const Case& c = run.description();
  CaseInput input;
  if (config_.measure == Measure::generation) {
    harness_works("making the PDFs");
    input.pdfs = &pdfs_.get(c);
    return input;
  }
  // A reference takes as long as it takes; when it brings the process down the case that asked for it is to
  // blame.
  if (!run.scored()) {
    observer_.now({c.id, "computing its reference", false});
    input.reference = &truth_->references.get(c);
    input.reference_info = &truth_->references.info(c);
    input.flip = &flip_;
    input.region = scene_.region;
  }
  input.exact = [this, &run](const std::vector<LightPoint>& lights) {
    return run.rest_limit([&] { return truth_->visibility.trace(*run.frame(), lights); });
  };
  return input;
}

CaseRun& SceneRun::open(const Case& c) {
  const auto begun = earlier_.begun.find(c.id);
  Case called_for = c;
  called_for.frame.effects = effects_.of(c.frame);
  CaseRun& run = runs_.emplace_back(
      called_for, config_, wall_, [this](const Activity& activity) { observer_.now(activity); },
      begun == earlier_.begun.end() ? CaseProgress() : begun->second);
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

// --- looking ---

void SceneRun::run(const std::vector<Case>& cases) {
  if (report_.effects.empty() && !config_.cases.empty()) {
    const FrameParameters& frame = (cases.empty() ? config_.cases : cases).front().frame;
    report_.effects = ledger(effects_.decisions(frame.width, frame.height));
  }
  runs_.reserve(cases.size() + 1);  // and the twin: a case's visibility callback keeps a pointer to it
  look_at_all(cases);
  if (config_.motion && !cases.empty()) look_at_motion();
  const bool twin = wants_twin_ && add_twin();
  SceneRounds(runs_, twin, config_, observer_, [this](CaseRun& run) {
    conclude(run);
  }).run(clocks_, &report_);
  if (config_.measure == Measure::frame) draw_sheet();
  if (config_.price_effects > 0 && !report_.effects_priced) price();
}

// While the device renders a case's seeds, the host measures those of the cases before it.
void SceneRun::look_at_all(const std::vector<Case>& cases) {
  Progress progress(report_.name + ": images", cases.size());
  const size_t ahead = std::max<size_t>(1, std::thread::hardware_concurrency() / std::max(1u, config_.seeds));
  size_t settled = 0;
  for (const Case& c : cases) {
    progress.label(c.id);
    CaseRun& run = open(c);
    run.look();
    images_.start(run);
    if (runs_.size() - settled > ahead) settle(runs_[settled++]);
    progress.advance();
  }
  while (settled < runs_.size()) settle(runs_[settled++]);
}

// What is looked at is told at once, so that no later end of this process can take it.
void SceneRun::settle(CaseRun& run) {
  const bool earlier = run.scored();
  run.settle();
  images_.finish(run);
  if (run.failed()) return conclude(run);
  if (earlier) return;
  if (run.misses_region()) warn_of_region(run.description());
  observer_.described(report_);
  observer_.scored(run.score());
}

// Once for each size of frame.
void SceneRun::warn_of_region(const Case& c) {
  const std::string warning =
      fmt::format("the camera sees no surface in the view's region at {}x{}; errors in it are not told",
                  c.frame.width, c.frame.height);
  if (std::ranges::count(report_.warnings, warning) > 0) return;
  report_.warnings.push_back(warning);
  log_warning("{}: {}", report_.name, warning);
}

// All of a scene's cases at once, frame by frame.
void SceneRun::look_at_motion() {
  if (frame_count(scene_) < 2) {
    log_warning("{}: stands still: no flicker is measured", report_.name);
    return;
  }
  SceneMotion motion(scene_, stage_, *truth_, config_, out_, report_, observer_, wall_);
  for (CaseRun& run : runs_) motion.add(run);
  motion.run();
  for (CaseRun& run : runs_) {
    if (run.concluded()) continue;
    if (run.failed()) {
      conclude(run);
    } else if (motion.has_measured(run)) {
      observer_.scored(run.score());
    }
  }
}

// The first case that has proved sound, under another name: what the two show as a difference is noise.
bool SceneRun::add_twin() {
  const auto sound = std::ranges::find_if(runs_, [](const CaseRun& r) { return !r.failed(); });
  if (sound == runs_.end()) return false;
  Case twin = sound->description();
  twin.id = twin_id(twin.id);
  open(twin);
  return true;
}

// --- concluding ---

void SceneRun::conclude(CaseRun& run) {
  const CaseResult result = run.result();
  run.conclude();
  harness_works("measuring");
  observer_.concluded(result);
  results_.push_back(result);
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

// --- pricing ---

// In the order of the experiment, whichever process has measured it; null: none.
const Case* SceneRun::first_sound_case() const {
  const auto is_sound = [](const Case& c, const std::vector<CaseResult>& results) {
    return std::ranges::any_of(results,
                               [&](const CaseResult& r) { return r.id == c.id && r.status == Status::ok; });
  };
  const auto found = std::ranges::find_if(config_.cases, [&](const Case& c) {
    return c.scene == report_.name && (is_sound(c, results_) || is_sound(c, earlier_.cases));
  });
  return found == config_.cases.end() ? nullptr : &*found;
}

// After everything else: nothing is timed beside it, the cases' frames are gone, and whatever goes wrong
// costs the prices alone.
void SceneRun::price() {
  const Case* c = first_sound_case();
  if (!c) return;
  const Stopwatch watch;
  const auto action = [&] {
    require_memory(stage_.device.info(), *c, 2 * kept_memory(*c));
    PricedFrame frame{load_method(c->method, stage_.device.info()), c->method_parameters, c->frame,
                      [this](const Frame& traced, const std::vector<LightPoint>& lights) {
                        return truth_->visibility.trace(traced, lights);
                      }};
    frame.parameters.effects = effects_.of(c->frame);
    const PriceOptions options{.rounds = config_.price_effects,
                               .now =
                                   [this](const std::string& what) {
                                     observer_.now({"", "pricing effects: " + what, true});
                                   },
                               .wall = wall_};
    EffectPricing pricing = pricing_of(price_effects(stage_, frame, options, &report_.effects));
    pricing.case_id = c->id;
    pricing.seconds = watch.seconds();
    report_.effects_priced = pricing;
    observer_.described(report_);
  };
  guarded(action, [&](ErrorKind, const std::string& message) {
    report_.warnings.push_back("its effects were not priced: " + message);
    log_warning("{}: {}", report_.name, report_.warnings.back());
    observer_.described(report_);
  });
}

}  // namespace

void run_scene(Device& device, KernelLibrary& kernels, const std::string& name, const Config& config,
               const std::vector<Case>& cases, const SceneOutcome& earlier, const SceneRunOptions& options,
               SceneObserver& observer, WallTime* wall) {
  const auto failed = [&](ErrorKind kind, const std::string& message) {
    for (const auto& result : failed_cases(cases, config, kind, message)) observer.concluded(result);
  };
  const auto run = [&] {
    observer.now({"", "loading the scene", false});
    Scene scene = load_scene(name, options.scenes);
    SceneReport report = describe(scene, name, config);
    const std::optional<Crop> region = report.region;
    // Cases from before the view had a region have no errors in it, and none that are wrong.
    const bool other_region = earlier.scene && earlier.scene->region && earlier.scene->region != region;
    if (earlier.scene && (earlier.scene->hash != report.hash || other_region)) {
      throw fail(ErrorKind::scene,
                 "{}: the scene has changed since its first cases were measured; start anew with --force",
                 name);
    }
    if (earlier.scene) report = *earlier.scene;
    report.region = region;
    log_info("{}: {} triangles", name, scene.triangles.size());
    for (const auto& warning : scene.warnings) log_warning("{}: {}", name, warning);
    observer.described(report);
    SceneRun(device, kernels, scene, config, report, earlier, options, observer, wall).run(cases);
  };
  guarded(run, failed);
}

}  // namespace vsglbench
