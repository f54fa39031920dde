// The effects that the cases of a scene are rendered with: what the scene calls for, with what a case forces
// and without what it skips.
#pragma once

#include <map>
#include <vector>

#include "frame/frame_parameters.h"
#include "report/report.h"
#include "scene/effects.h"

namespace vsglbench {

class SceneEffects {
 public:
  explicit SceneEffects(const Scene& scene) : scene_(scene) {}
  // What a case's frame simulates. Shadow maps are there whenever a case asks for them, as their own errors
  // are part of what is measured; rays and no test at all see the same where nothing occludes.
  EffectSet of(const FrameParameters& parameters);
  // For images of this shape; derived once for each.
  const std::vector<EffectDecision>& decisions(uint32_t width, uint32_t height);

 private:
  const Scene& scene_;
  std::map<float, std::vector<EffectDecision>> decisions_;  // by aspect
};

// The ledger as a report holds it, without times and bytes.
std::vector<EffectReport> ledger(const std::vector<EffectDecision>& decisions);

}  // namespace vsglbench
