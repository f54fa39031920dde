// Kernels that were built into a plugin (cmake/EmbedKernels.cmake), so that a copy of it keeps them.
#pragma once

#include <filesystem>

namespace vsglbench {

// Writes `files`, pairs of name and text up to a null, to the cache under their hash; returns the folder of
// the method's own kernels, beside which lies what they include; empty for null. Throws Error(output).
std::filesystem::path unpack_kernels(const char* const* files);

// What kernels in `folder`, when that was unpacked, include; empty for any other folder.
std::filesystem::path kept_includes(const std::filesystem::path& folder);

}  // namespace vsglbench
