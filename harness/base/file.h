// Files: whole reads, and writes that either finish or leave what was there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vsglbench {

// The whole file; throws Error(kind output) with path and reason.
std::string read_text(const std::filesystem::path& path);
std::vector<uint8_t> read_bytes(const std::filesystem::path& path);

// Calls `write(temporary)` in the target's folder, then renames onto `path`. On any failure (read-only
// folder, full disk, exception) the temporary is removed, `path` keeps its old content and Error(output)
// says path and reason. Creates parent folders.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);
void write_text(const std::filesystem::path& path, std::string_view text);

// Makes sure that `dir` exists and takes a file; throws Error(output).
void ensure_writable_directory(const std::filesystem::path& dir);

// $VSGLBENCH_CACHE, else $XDG_CACHE_HOME/vsglbench, else $HOME/.cache/vsglbench, else ./.cache.
std::filesystem::path cache_directory();

// Folder of this library, "lib" of an installed or built vsglbench.
std::filesystem::path library_directory();

// Folder of kernels, scenes, configs, schemas: $VSGLBENCH_ROOT, else ../share/vsglbench beside
// library_directory(), else the source tree of this build folder. Throws Error(usage) in a build folder that
// was copied without its source tree.
std::filesystem::path data_root();

}  // namespace vsglbench
