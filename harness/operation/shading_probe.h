// Single lights at single surfaces on the device, by the functions of harness/shaders that pixels and methods
// call.
#pragma once

#include <vector>

#include "gpu/recorder.h"
#include "method/context.h"
#include "method/made_half.h"

namespace vsglbench {

// A light at a surface. The surface is a Vpl record whose `incident` points to the viewer.
struct ShadingPair {
  gpu::Vpl surface{};
  gpu::Vsgl light{};
  gpu::Vpl texel{};  // whose BRDF a cancelled light has, or a filtered one; or the virtual spherical light
};

// Modes of approximation.comp.
enum class ProbeMode { vsgl, cancelled, vsl, filtered };

class ShadingProbe {
 public:
  explicit ShadingProbe(Device& device) : kernels_(device), recorder_(device) {}
  // rgb: radiance, W/(m² sr), `runs` values a pair; a: 1 where bias reduction cancels the pair at `alpha`.
  std::vector<glm::vec4> shade(const std::vector<ShadingPair>& pairs, ProbeMode mode,
                               ShaderDefines defines = {}, float alpha = 0, uint32_t runs = 1);
  // All texels of a half as one light.
  gpu::Vsgl light_of(const oracle::Half& half);

 private:
  KernelLibrary kernels_;
  Recorder recorder_;
};

}  // namespace vsglbench
