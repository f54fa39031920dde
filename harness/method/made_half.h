// Made-up halves, for tests and the conformance kit: texels without a scene, on the host and on the device.
#pragma once

#include <array>
#include <vector>

#include "method/method.h"
#include "method/oracle.h"

namespace vsglbench {

// A spot 4 m above the floor that looks down on it: the emitter of every half below.
gpu::Emitter spot(uint32_t width, uint32_t height);

// A spot over a wavy floor with random materials, 5 % of the texels without a surface; `seed` decides
// materials, heights and the PDF.
oracle::Half random_half(uint32_t width, uint32_t height, uint32_t seed);

// A spot over gentle waves, every texel a surface whose material changes slowly. The PDF is honest: a texel's
// reflected power times a slowly varying importance, so it is zero nowhere.
oracle::Half smooth_half(uint32_t width, uint32_t height);

// The same texels under a PDF as a view makes it: above 0 everywhere, but changing by a factor of 16 at the
// edges of what is seen, and by as much again over a few texels.
oracle::Half uneven_half(uint32_t width, uint32_t height);

// As the eye sees it: every texel emits the same importance.
void look_from_eye(oracle::Half& half);

// The PDF pyramid in single precision, as the harness lays it out (shaders/pyramid.glsl).
std::vector<float> pdf_pyramid(const oracle::Half& half);

// Σ over texels of what the power of a light of this kind stands for, in double: luminance of the reflected
// power, or of the incident flux (LightKindInfo). W.
double texel_power(const oracle::Half& half, LightKind kind);

// A half in device memory. As the rasteriser leaves it, a texel without a surface is all zero.
class DeviceHalf {
 public:
  DeviceHalf(Device& device, const oracle::Half& half);
  // `with_pdf` false: as for a method that uses no importance.
  Field field(Half half, bool with_pdf = true) const;

 private:
  gpu::Emitter emitter_{};
  std::array<DeviceImage, 5> maps_;
  Buffer pdf_;
};

}  // namespace vsglbench
