// The parts of a frame, in the order in which it runs them.
#pragma once

#include <optional>

#include "frame/importance.h"
#include "frame/shade_pass.h"

namespace vsglbench {

struct FrameParts {
  // Throws Error(case_failed) for sizes the device can't take, N = 0 or N > texels.
  FrameParts(Stage& stage, const MethodInfo& method, const Json& method_parameters,
             const FrameParameters& parameters, ExactVisibility exact);
  FrameParts(const FrameParts&) = delete;
  FrameParts& operator=(const FrameParts&) = delete;

  Stage& stage;
  const FrameParameters parameters;
  LightGenerator generator;  // the method under test
  Halves halves;
  std::optional<ImportancePass> importance;  // none where the method uses none
  HalfLights lights;                         // on the RSM
  ShadePass shade;

  // On the G-buffer; null where there are none.
  const HalfLights* importance_lights() const { return importance ? importance->lights() : nullptr; }
  // The method under test, once a half on which it makes lights.
  std::vector<const LightGenerator*> generators() const;
  const HalfLights* lights_on(Half half) const { return half == Half::rsm ? &lights : importance_lights(); }
};

}  // namespace vsglbench
