// What `fis` and `mfis` share: the moment pyramid and the dispatch of the sampling kernel [MFIS16 §4, App.
// D].
#pragma once

#include <memory>
#include <string>

#include "method/light_kernel.h"
#include "method/method.h"

namespace vsglbench {

// Vec4 buffers, a pyramid each, one and two for each lobe of the lights, as shaders/moments_buffers.glsl
// numbers them and says what they hold.
struct MomentBuffers {
  std::vector<const Buffer*> buffers;
  std::vector<Binding> bindings() const {
    std::vector<Binding> out;
    for (const Buffer* buffer : buffers) out.emplace_back(*buffer);
    return out;
  }
};

// The pyramid of leaf moments of one half: steps `resolve` and `mipmap`.
class MomentPyramid {
 public:
  explicit MomentPyramid(MethodContext& context);
  MomentBuffers build(Steps& steps, const Field& field);

 private:
  MethodContext& context_;
  const Kernel &resolve_, &mip_;
};

// What build() left of that half in the scratch memory of this context, as the filter read it; no buffers
// where it was never called there. It lasts as scratch memory does, for one frame.
MomentBuffers built_moments(const MethodContext& context, Half half);

// A method whose kernel file includes filtered_sampling.glsl; `footprint_size` is K. `defines`: of that file.
// `carried_bytes`: of each light's state, where the kernel carries one from frame to frame (CARRIED there).
std::unique_ptr<Method> make_filtered_sampling(MethodContext& context, const std::string& kernel_file,
                                               float footprint_size, const ShaderDefines& defines = {},
                                               size_t carried_bytes = 0);

// Texels of a whole pyramid over width × height (shaders/pyramid.glsl).
uint64_t pyramid_texels(uint32_t width, uint32_t height);
// Index of its last level, which has one texel.
uint32_t pyramid_top(uint32_t width, uint32_t height);

}  // namespace vsglbench
