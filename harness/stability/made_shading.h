// Lights at made-up surfaces, on the device: frame/shade.comp as a frame runs it, without visibility.
#pragma once

#include "frame/light_records.h"
#include "frame/shading.h"
#include "gpu/recorder.h"
#include "method/made_half.h"

namespace vsglbench {

class MadeShading {
 public:
  explicit MadeShading(KernelLibrary& kernels) : kernels_(kernels), recorder_(kernels.device()) {}
  struct Shaded {
    std::vector<glm::vec3> radiance;  // at each texel of `receivers`, row-major, whose emitter is the eye
    std::vector<gpu::FilteredLight> filtered;  // what it is by, where `shading` is filtered
  };
  // `rsm`: what the lights were made of.
  Shaded shade(const oracle::Half& receivers, const DeviceHalf& rsm, const LightRecords& lights,
               const Shading& shading);

 private:
  KernelLibrary& kernels_;
  Recorder recorder_;
};

}  // namespace vsglbench
