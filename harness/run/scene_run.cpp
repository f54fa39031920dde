#include "run/scene_run.h"

#include <algorithm>
#include <map>

#include "base/log.h"
#include "gpu/shader_compiler.h"
#include "measure/stopwatch.h"
#include "reference/cache.h"
#include "reference/visibility.h"

namespace vsglbench {
namespace {

// Answers exact visibility with the ray tracer, for the G-buffer that is on the device.
class VisibilityTracer {
 public:
  VisibilityTracer(const Tracer& tracer, WallTime* wall) : tracer_(tracer), wall_(wall) {}

  std::vector<uint32_t> trace(Frame& frame, const std::vector<LightPoint>& lights) {
    const Stopwatch watch;
    const auto& receivers = receivers_of(frame);
    std::vector<TargetPoint> targets;
    for (const auto& light : lights) targets.push_back({light.position, light.stop_short});
    auto bits = compute_visibility(tracer_, receivers, frame.camera().width, frame.camera().height, targets);
    wall_->visibility += watch.seconds();
    return std::move(bits.words);
  }

 private:
  const std::vector<ReceiverPoint>& receivers_of(Frame& frame) {
    auto& points = receivers_[{frame.camera().width, frame.camera().height}];
    if (points.empty()) {
      const auto position = download_map(frame.gbuffer().maps[0]);
      const auto normal = download_map(frame.gbuffer().maps[2]);
      for (size_t i = 0; i < position.size(); ++i) {
        points.push_back({glm::vec3(position[i]), glm::vec3(normal[i]), position[i].w > 0});
      }
    }
    return points;
  }
  const Tracer& tracer_;
  WallTime* wall_;
  std::map<std::pair<uint32_t, uint32_t>, std::vector<ReceiverPoint>> receivers_;
};

// The references that the cases ask for, by frame size and occlusion.
class References {
 public:
  References(const Scene& scene, const Config& config, WallTime* wall) : scene_(scene), config_(config), wall_(wall) {}

  // Throws Error(case_failed) when the camera or the light sees nothing, or no light comes back.
  const ReferenceResult& get(const Case& c) {
    const bool occlusion = c.frame.visibility != Visibility::none;
    auto& slot = results_[{c.frame.width, c.frame.height, occlusion}];
    if (slot) return *slot;
    const Stopwatch watch;
    ReferenceParameters p;
    p.width = c.frame.width;
    p.height = c.frame.height;
    p.samples = config_.reference.samples;
    p.batches = config_.reference.batches;
    p.seed = config_.reference.seed;
    p.occlusion = occlusion;
    bool cached = false;
    ReferenceResult result = load_or_compute(scene_, p, &cached);
    wall_->references += watch.seconds();
    const bool black = std::all_of(result.mean.pixels.begin(), result.mean.pixels.end(),
                                   [](const glm::vec3& v) { return v == glm::vec3(0); });
    if (black) throw fail(ErrorKind::case_failed, "no indirect light reaches the view: the reference is black");
    log_info("{}: reference{} of {} samples {} ({}), noise floor {:.2f} % SMAPE", scene_.name,
             occlusion ? "" : " without occlusion", result.samples, cached ? "from the cache" : "computed",
             format_duration(watch.seconds()), result.noise_floor_smape);
    slot = std::make_unique<ReferenceResult>(std::move(result));
    return *slot;
  }

 private:
  const Scene& scene_;
  const Config& config_;
  WallTime* wall_;
  std::map<std::tuple<uint32_t, uint32_t, bool>, std::unique_ptr<ReferenceResult>> results_;
};

// Every case in the order given, one frame each, round after round, until all are done.
void measure_interleaved(std::vector<CaseRun>& cases, const std::string& scene, uint32_t warmup, WallTime* wall) {
  uint64_t frames = 0;
  for (const auto& c : cases) frames += c.frames_left() + warmup;
  Progress progress(scene, frames);
  for (uint32_t i = 0; i < warmup; ++i) {
    for (auto& c : cases) {
      progress.label(c.description().id);
      c.warm_up(wall);
      progress.advance();
    }
  }
  const auto unfinished = [](const CaseRun& c) { return !c.finished(); };
  while (std::any_of(cases.begin(), cases.end(), unfinished)) {
    for (auto& c : cases) {
      if (c.finished()) continue;
      progress.label(c.description().id);
      c.step(wall);
      progress.advance();
    }
  }
}

std::vector<CaseRun> open_cases(Stage& stage, References& references, VisibilityTracer& visibility,
                                const Config& config, const std::vector<Case>& cases) {
  std::vector<CaseRun> runs;
  runs.reserve(cases.size());
  for (const Case& c : cases) {
    try {
      runs.emplace_back(c, config, &references.get(c));
    } catch (const Error& e) {
      runs.emplace_back(c, config, nullptr);
      runs.back().fail_with(e);
    }
  }
  for (auto& run : runs) {  // after all are in place: the callback keeps a pointer to its case
    CaseRun* self = &run;
    run.open(stage, [self, &visibility](const auto& lights) { return visibility.trace(*self->frame(), lights); });
  }
  return runs;
}

std::optional<AaPair> aa_pair(const CaseRun& a, const CaseRun& twin) {
  if (a.failed() || twin.failed() || a.span_samples().empty() || twin.span_samples().empty()) return std::nullopt;
  AaPair pair;
  pair.case_id = a.description().id;
  pair.twin_id = twin.description().id;
  pair.ratio = median_ratio(a.span_samples(), twin.span_samples());
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

// The scene on the device, all its cases measured, their images written.
void measure_scene(Device& device, KernelLibrary& kernels, const Scene& scene, const std::string& name,
                   const Config& config, std::vector<Case> cases, const SceneRunOptions& options, WallTime* wall,
                   SceneOutcome* outcome) {
  const Stopwatch build;
  const Tracer tracer(scene);
  wall->references += build.seconds();
  const double compiled = shader_statistics().seconds;
  Stage stage(device, kernels, scene);
  References references(scene, config, wall);
  VisibilityTracer visibility(tracer, wall);
  if (options.aa) {
    cases.push_back(cases.front());
    cases.back().id += " (A/A twin)";
  }
  auto runs = open_cases(stage, references, visibility, config, cases);
  wall->compilation += shader_statistics().seconds - compiled;
  measure_interleaved(runs, name, config.warmup, wall);
  if (options.aa) {
    outcome->aa = aa_pair(runs.front(), runs.back());
    runs.pop_back();
  }
  for (auto& run : runs) outcome->cases.push_back(run.result());
  const auto drawn = std::find_if(runs.begin(), runs.end(), [](const CaseRun& r) { return r.image().has_value(); });
  if (drawn == runs.end()) return;
  outcome->scene->exposure = auto_exposure(drawn->reference()->mean, drawn->reference()->mask);
  const Image direct = drawn->frame() ? drawn->frame()->render_direct() : Image();
  outcome->scene->contact = write_images(options.out, name, runs, outcome->cases,
                                         static_cast<float>(outcome->scene->exposure), direct);
}

void fail_all(const std::vector<Case>& cases, const Config& config, const std::string& kind,
              const std::string& message, SceneOutcome* outcome) {
  outcome->cases.clear();
  for (const Case& c : cases) {
    CaseRun run(c, config, nullptr);
    run.fail_with(kind, message);
    outcome->cases.push_back(run.result());
  }
}

}  // namespace

SceneOutcome run_scene(Device& device, KernelLibrary& kernels, const std::string& name, const Config& config,
                       const std::vector<Case>& cases, const SceneRunOptions& options, WallTime* wall) {
  SceneOutcome outcome;
  try {
    const Scene scene = load_scene(name, options.scenes);
    outcome.scene = describe(scene, name);
    log_info("{}: {} triangles", name, scene.triangles.size());
    for (const auto& warning : scene.warnings) log_warning("{}: {}", name, warning);
    measure_scene(device, kernels, scene, name, config, cases, options, wall, &outcome);
  } catch (const AssetMissing& e) {
    fail_all(cases, config, "asset_missing", e.what(), &outcome);
  } catch (const Error& e) {
    if (outcome.cases.size() == cases.size()) throw;  // measured, but the images can't be written
    fail_all(cases, config, error_kind(e) == "input" ? "scene" : error_kind(e), e.what(), &outcome);
  }
  return outcome;
}

}  // namespace vsglbench
