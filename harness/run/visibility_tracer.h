// Answers exact visibility with the ray tracer, for the G-buffer that is on the device.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "frame/frame.h"
#include "reference/visibility.h"
#include "report/report.h"

namespace vsglbench {

class VisibilityTracer {
 public:
  VisibilityTracer(const Tracer& tracer, WallTime* wall) : tracer_(tracer), wall_(wall) {}

  // After the scene has moved.
  void forget() { receivers_.clear(); }
  // Bits as ExactVisibility asks for them. Throws Error(case_failed) for a light that stands nowhere: a
  // position that is not finite, or far outside of the scene.
  std::vector<uint32_t> trace(const Frame& frame, const std::vector<LightPoint>& lights);

 private:
  const std::vector<ReceiverPoint>& receivers_of(const Frame& frame);
  TargetPoint target_of(const LightPoint& light, size_t index) const;
  const Tracer& tracer_;
  WallTime* wall_;
  // By frame size and effects: a mask that is left out leaves other surfaces.
  std::map<std::tuple<uint32_t, uint32_t, EffectSet>, std::vector<ReceiverPoint>> receivers_;
};

}  // namespace vsglbench
