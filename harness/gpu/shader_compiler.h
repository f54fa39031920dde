// GLSL to SPIR-V at run time (glslang), so that a kernel is edited and rerun without a rebuild.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vsglbench {

// -DNAME=VALUE, in the order of the names.
using ShaderDefines = std::map<std::string, std::string>;

// Compiles `path` for Vulkan 1.3; the stage follows from the suffix (.comp .vert .frag). `#include "x"` is
// looked up beside the including file, then in `include_dirs`. The result is kept on disk under a hash of
// the preprocessed source (which holds every include and define), stage and compiler version.
// Throws Error(plugin) "FILE:LINE: message" for the first compile error.
std::vector<uint32_t> compile_shader(const std::filesystem::path& path, const ShaderDefines& defines,
                                     const std::vector<std::filesystem::path>& include_dirs);

// Hash over every kernel and include of the harness and its methods as they are on disk now: two runs whose
// kernels were edited in between differ in it, whatever the binary is.
std::string kernel_sources_hash();

// What compile_shader did since the program began.
struct ShaderStatistics {
  unsigned compiled = 0, from_cache = 0;
  double seconds = 0;
};
const ShaderStatistics& shader_statistics();

}  // namespace vsglbench
