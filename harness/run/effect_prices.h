// What each effect of a scene costs, or what skipping it saves: one frame with the effect and without it, in
// turn.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "report/report.h"

namespace vsglbench {

struct PricedFrame {
  const MethodInfo& method;
  Json method_parameters;
  FrameParameters parameters;  // its effects are those that the case is rendered with
  ExactVisibility exact;       // of a frame that asks for it, whose time is not counted
};

// A frame as the case has it, and with all effects.
struct EffectSaving {
  Summary derived_ms, forced_ms;  // of all passes but gbuffer and rsm
  Summary derived_span_ms, forced_span_ms;
  int64_t derived_bytes = 0, forced_bytes = 0;  // Frame::memory_bytes()
};

// Of each effect in `ledger` but motion's: `ms`, the median over `rounds` rounds of the difference between a
// frame's span with the effect and without it, its 95 % bootstrap interval, and the difference of
// Frame::memory_bytes(). Throws as Frame does.
EffectSaving price_effects(Stage& stage, const PricedFrame& frame, uint32_t rounds,
                           std::vector<EffectReport>* ledger);

}  // namespace vsglbench
