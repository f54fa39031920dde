// The simplest kind of method: one kernel, one invocation a light, each light from texels drawn by the PDF.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "method/method.h"

namespace vsglbench {

// A method made of one kernel that includes light_kernel.glsl and defines `LIGHT make_light(uint i)`, LIGHT
// being the record of the kind: Vsgl, or Vpl of vpl and vsl. Its one pass is `sample`. `parameters`: at most
// 4, which the kernel reads as parameter[0..3].
std::unique_ptr<Method> make_light_kernel(MethodContext& context, const std::string& kernel_file,
                                          LightKind kind, const std::vector<float>& parameters = {});

// floor(2^32/N), the lattice's step in 32-bit fixed point (shaders/warp.glsl); 0 for N = 1.
uint32_t lattice_step(uint32_t count);

}  // namespace vsglbench
