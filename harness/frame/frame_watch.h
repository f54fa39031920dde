// What a frame's passes wrote, as the watches over memory and passes ask for it.
#pragma once

#include <string>

#include "frame/frame_parts.h"
#include "frame/memory_watch.h"
#include "frame/pass_check.h"

namespace vsglbench {

// Around a frame: arm(), the passes, look().
class FrameWatch {
 public:
  explicit FrameWatch(const FrameParts& parts) : parts_(parts) {}
  void restart() { fault_.clear(); }
  // `carried`: null where this is no frame of an animation.
  void arm(const CarriedLights* carried = nullptr);
  void look();
  // Which lights no kernel wrote, and what was written past the end of a buffer that the method may write;
  // empty: nothing. The first fault since restart() stays.
  const std::string& fault() const { return fault_; }

 private:
  void arm_half(Half half);
  void arm_scratch();
  const FrameParts& parts_;
  MemoryWatch memory_;
  std::string fault_;
};

// For PassCheck: which buffer of the frame a pass wrote, and how large what it works on is.
FrameOutputs outputs_of(const FrameParts& parts);

}  // namespace vsglbench
