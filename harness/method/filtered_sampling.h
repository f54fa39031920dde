// What `fis` and `mfis` share: the moment pyramid and the dispatch of the sampling kernel [MFIS16 §4, App.
// D].
#pragma once

#include <memory>
#include <string>

#include "method/light_kernel.h"
#include "method/method.h"

namespace vsglbench {

// Five vec4 buffers, a pyramid each, as shaders/moments_buffers.glsl numbers them and says what they hold.
struct MomentBuffers {
  std::array<const Buffer*, 5> buffers{};
  std::array<Binding, 5> bindings() const {
    return {*buffers[0], *buffers[1], *buffers[2], *buffers[3], *buffers[4]};
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

// A method whose kernel file includes filtered_sampling.glsl; `footprint_size` is K. `defines`: of that file.
std::unique_ptr<Method> make_filtered_sampling(MethodContext& context, const std::string& kernel_file,
                                               float footprint_size, const ShaderDefines& defines = {});

// Texels of a whole pyramid over width × height (shaders/pyramid.glsl).
uint64_t pyramid_texels(uint32_t width, uint32_t height);
// Index of its last level, which has one texel.
uint32_t pyramid_top(uint32_t width, uint32_t height);

}  // namespace vsglbench
