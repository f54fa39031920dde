// Inside the conformance kit: a method at work on made-up halves, watched.
#pragma once

#include <memory>

#include "conformance/inputs.h"
#include "conformance/lights.h"

namespace vsglbench {

// One frame of one half.
struct HalfOutput {
  LightRecords lights;
  std::vector<PassTime> passes;
  unsigned dispatches_outside = 0;  // of any pass
  std::string overrun;              // which buffer was written past its end, and where; empty: none
};

// One Method with a recorder and scratch memory of its own.
class MethodRun {
 public:
  MethodRun(KernelLibrary& kernels, const MethodInfo& info, const Json& parameters);
  ~MethodRun();

  Method& method() { return *method_; }
  // Throws Error(case_failed) where the lights are over the device's storage-buffer range.
  HalfOutput frame(const DeviceHalf& texels, Half half, uint32_t wanted, glm::uvec2 shift);

  // Makes the scratch buffers that `other` has asked for, full of what another case could have left there and
  // longer by guard words, which frame() then looks at. Before the first frame.
  void guard_scratch_like(MethodRun& other);
  // From now on the guards are as long as the device and the host can well bear: a write far past the end of
  // a buffer ends in its own guard. Before guard_scratch_like().
  void widen_guards(const MethodRun& other);

 private:
  std::string overrun_scratch();
  size_t guard_behind(size_t bytes) const;
  KernelLibrary& kernels_;
  ScratchPool scratch_;
  Recorder recorder_;
  MethodContext context_;
  std::unique_ptr<Method> method_;
  std::map<std::string, size_t> guarded_;  // bytes before the guard, by name
  size_t guard_bytes_;
};

}  // namespace vsglbench
