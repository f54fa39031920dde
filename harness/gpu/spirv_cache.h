// Compiled kernels on disk. A file is the hash of the words, in hex, and then the words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vsglbench {

// False where there is no such file or it is damaged.
bool read_cached_spirv(const std::filesystem::path& path, std::vector<uint32_t>* spirv);

// A cache that can't be written is a warning.
void write_cached_spirv(const std::filesystem::path& path, const std::vector<uint32_t>& spirv);

}  // namespace vsglbench
