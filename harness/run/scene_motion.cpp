#include "run/scene_motion.h"

#include <algorithm>

#include "base/log.h"
#include "base/progress.h"
#include "scene/animation.h"

namespace vsglbench {

SceneMotion::SceneMotion(Scene& scene, Stage& stage, GroundTruth& truth, const Config& config,
                         std::filesystem::path out, const SceneReport& report, SceneObserver& observer,
                         WallTime* wall)
    : scene_(scene),
      stage_(stage),
      truth_(truth),
      config_(config),
      images_(std::move(out), scene),
      report_(report),
      observer_(observer),
      wall_(wall) {}

uint32_t SceneMotion::frames() const {
  const uint32_t all = frame_count(scene_), wanted = config_.motion->frames;
  return wanted > 0 ? std::min(wanted, all) : all;
}

void SceneMotion::add(CaseRun& run) {
  if (run.failed() || run.has_temporal() || !run.frame()) return;
  cases_.emplace_back(run, config_.motion->seeds);
}

bool SceneMotion::has_measured(const CaseRun& run) const {
  return !run.failed() && std::ranges::any_of(cases_, [&](const CaseFlicker& c) { return &c.run() == &run; });
}

void SceneMotion::run() {
  if (cases_.empty()) return;
  Progress progress(report_.name + ": motion", uint64_t(frames()) * cases_.size());
  for (uint32_t frame = 0; frame < frames(); ++frame) {
    pose(frame);
    for (CaseFlicker& c : cases_) {
      look(c, frame);
      progress.advance();
    }
  }
  pose(0);
  stage_.still_layers.clear();
  for (CaseFlicker& c : cases_) finish(c);
}

void SceneMotion::pose(uint32_t frame) {
  const Moved moved = set_frame(&scene_, frame);
  stage_.follow(moved);
  truth_.tracer.update(moved);
  if (moved.any()) truth_.visibility.forget();
  for (CaseFlicker& c : cases_) c.run().follow(moved);
  for (auto& [key, references] : references_) references.present.reset();
}

SceneMotion::References& SceneMotion::references_of(const CaseRun& run) {
  const ReferenceParameters p = reference_parameters(config_, run.description());
  return references_[{p.width, p.height, p.occlusion}];
}

const ReferenceResult& SceneMotion::reference_of(const CaseRun& run, uint32_t frame) {
  const Case& c = run.description();
  References& r = references_of(run);
  if (r.error) throw *r.error;
  if (r.present) return *r.present;
  const ReferenceParameters p = reference_parameters(config_, c);
  observer_.now({c.id, fmt::format("computing its reference of frame {}", frame), false});
  if (!r.sequence) r.sequence = std::make_unique<ReferenceSequence>(scene_, p);
  const Stopwatch watch;
  try {
    r.present = r.sequence->present([this]() -> const Tracer& { return truth_.tracer; });
  } catch (const Error& e) {
    r.error = e;
    throw;
  }
  wall_->references_s += watch.seconds();
  r.halves.add(r.present->half[0], r.present->half[1], r.present->mask);
  r.unlit.add(Image(p.width, p.height), r.present->mean, r.present->mask);
  images_.write(c, frame, *r.present);
  return *r.present;
}

void SceneMotion::look(CaseFlicker& flicker, uint32_t frame) {
  CaseRun& run = flicker.run();
  if (run.failed()) return;
  guarded(
      [&] {
        const auto seen = flicker.look(frame, reference_of(run, frame));
        if (seen) images_.write(run.description(), frame, *seen);
      },
      [&](ErrorKind kind, const std::string& message) {
        run.fail_with(kind, fmt::format("frame {} in motion: {}", frame, message));
      });
}

Temporal SceneMotion::temporal_of(const CaseFlicker& flicker) {
  Temporal out = flicker.finish();
  const References& r = references_of(flicker.run());
  const auto halves = r.halves.finish(), unlit = r.unlit.finish();
  if (!halves || !unlit)
    throw fail(ErrorKind::case_failed, "the references are black: flicker has no measure");
  // The halves differ by twice the noise of their mean.
  out.noise_floor = halves->value * halves->mean_reference / 2 / unlit->mean_reference;
  out.unlit = unlit->value;
  return out;
}

// Pictures that can't be drawn cost the case in the end, and not its numbers.
void SceneMotion::finish(CaseFlicker& flicker) {
  CaseRun& run = flicker.run();
  if (run.failed()) return;
  observer_.now({run.description().id, "drawing its flicker", false});
  guarded([&] { run.add_temporal(temporal_of(flicker)); },
          [&](ErrorKind kind, const std::string& message) { run.fail_with(kind, message); });
  if (run.failed()) return;
  guarded(
      [&] {
        run.add_images(
            images_.draw(run.description(), flicker.meter(), static_cast<float>(report_.exposure)));
      },
      [&](ErrorKind kind, const std::string& message) { run.fail_in_the_end(kind, message); });
}

}  // namespace vsglbench
