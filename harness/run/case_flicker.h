// How much one case flickers over the frames of its scene. Fed frame by frame; keeps the meters of its seeds.
#pragma once

#include <optional>
#include <vector>

#include "image/detail.h"
#include "image/flicker.h"
#include "run/case_run.h"

namespace vsglbench {

class CaseFlicker {
 public:
  // Over `seeds` seeds, and of frame 0 over as many as the case is looked at with, of which the first 32 tell
  // its static flicker; over one of a case that does not draw its lights.
  CaseFlicker(CaseRun& run, uint32_t seeds);
  CaseRun& run() const { return run_; }

  // Renders the pose that the scene is in. The image of seed 0 and its mask; nothing where the case fails.
  std::optional<CaseRun::Look> look(uint32_t frame, const ReferenceResult& reference);
  // All but what the references alone tell. Throws Error(case_failed) where they are black.
  Temporal finish() const;

  // Of seed 0.
  const DerivativeFlickerMeter& meter() const { return seeds_.front().flicker; }

 private:
  struct Seed {
    DerivativeFlickerMeter flicker;
    DetailMeter detail;
    Carried carried;
  };
  void look_at_frozen(const std::vector<Image>& images, const Mask& mask, const ReferenceResult& reference);
  std::optional<DetailResult> detail() const;
  CaseRun& run_;
  std::vector<Seed> seeds_;
  std::optional<FlickerSeries> frozen_;
  std::vector<std::string> references_;
};

}  // namespace vsglbench
