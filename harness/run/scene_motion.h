// A scene's cases over its frames, all at once: a frame is posed and its reference obtained once for all of
// them. Each frame's images are measured and written, and none is kept.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <tuple>

#include "reference/sequence.h"
#include "run/case_flicker.h"
#include "run/ground_truth.h"
#include "run/motion_images.h"
#include "run/scene_run.h"

namespace vsglbench {

class SceneMotion {
 public:
  // `scene` is what `stage` and `truth` are of; it is in frame 0. All of them outlive this.
  SceneMotion(Scene& scene, Stage& stage, GroundTruth& truth, const Config& config, std::filesystem::path out,
              const SceneReport& report, SceneObserver& observer, WallTime* wall);
  // A case that is scored; nothing for one that has failed, or whose flicker is known. It outlives this.
  void add(CaseRun& run);
  // Leaves the scene, and all that follows it, in frame 0. What goes wrong fails the case that it concerns;
  // throws Error(device_lost) only.
  void run();
  // Of a case that was added and has not failed.
  bool has_measured(const CaseRun& run) const;

 private:
  // The reference of the frame at hand, of all cases of a size and occlusion.
  struct References {
    std::unique_ptr<ReferenceSequence> sequence;
    std::optional<ReferenceResult> present;
    std::optional<Error> error;
    DerivativeFlickerMeter halves, unlit;  // of one half of the samples beside the other; of a black image
  };
  using Key = std::tuple<uint32_t, uint32_t, bool>;
  uint32_t frames() const;
  void pose(uint32_t frame);
  const ReferenceResult& reference_of(const CaseRun& run, uint32_t frame);
  void look(CaseFlicker& flicker, uint32_t frame);
  void finish(CaseFlicker& flicker);
  Temporal temporal_of(const CaseFlicker& flicker);
  References& references_of(const CaseRun& run);
  Scene& scene_;
  Stage& stage_;
  GroundTruth& truth_;
  const Config& config_;
  MotionImages images_;
  const SceneReport& report_;
  SceneObserver& observer_;
  WallTime* wall_;
  std::list<CaseFlicker> cases_;
  std::map<Key, References> references_;
};

}  // namespace vsglbench
