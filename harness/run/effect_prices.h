// What each effect of a scene costs, or what skipping it saves: one frame with the effect and without it, in
// turn.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "report/report.h"

namespace vsglbench {

struct PricedFrame {
  const MethodInfo& method;
  Json method_parameters;
  FrameParameters parameters;  // its effects are those that the case is rendered with
  // Bits of exact visibility, of a frame that asks for it; their time is not counted.
  std::function<std::vector<uint32_t>(const Frame& frame, const std::vector<LightPoint>& lights)> exact;
};

// How it is done.
struct PriceOptions {
  uint32_t rounds = 8;  // at least 1
  // Frames that are held at a time beside the case's own; 0: as many as a quarter of the memory has room for.
  size_t at_once = 0;
  std::function<void(const std::string& action)> now;  // at the start of every action; may be empty
  WallTime* wall = nullptr;                            // device and compilation time are added to it
};

// A frame as the case has it, and with all effects, in turn.
struct EffectSaving {
  Summary derived_ms, forced_ms;  // of all passes but gbuffer and rsm
  Summary derived_span_ms, forced_span_ms;
  int64_t derived_bytes = 0, forced_bytes = 0;  // Frame::memory_bytes()
};

// Of each effect in `ledger` but motion's: `ms`, the median over the rounds of the difference between a
// frame's span with the effect and without it, its 95 % bootstrap interval, and the difference of
// Frame::memory_bytes(). Throws as Frame does; the ledger is then as it was.
EffectSaving price_effects(Stage& stage, const PricedFrame& frame, const PriceOptions& options,
                           std::vector<EffectReport>* ledger);

// What a report says of it, but for the case and the seconds.
EffectPricing pricing_of(const EffectSaving& saving);

}  // namespace vsglbench
