// VSGLs as `shading` filtered evaluates them.
#pragma once

#include "frame/shading.h"
#include "gpu/recorder.h"
#include "method/light_kind.h"
#include "method/method.h"

namespace vsglbench {

bool is_filtered(LightKind kind, const Shading& shading);

// Bytes of a kernel's FilteredLight (shaders/types.h).
size_t filtered_light_stride(unsigned lobes);

// Records one dispatch that makes one of each of `count` VSGLs; `effects`: the permutation of the RSM.
void record_filtered_lights(Recorder& recorder, KernelLibrary& kernels, const Field& rsm,
                            const Shading& shading, const ShaderDefines& effects, const Buffer& lights,
                            uint32_t count, const Buffer& filtered);

// As the host has them, with both lobes; the fields of a lobe that the kernel left out are 0, but for a width
// of 1.
std::vector<gpu::FilteredLight> read_filtered_lights(const Buffer& filtered, size_t count, unsigned lobes);

}  // namespace vsglbench
