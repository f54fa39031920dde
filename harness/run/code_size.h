// How much code and how many dispatches a method takes: [MFIS16] Tab. 3.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "method/method.h"

namespace vsglbench {

struct CodeSize {
  std::string method;
  size_t kernels = 0;               // compiled, variants counted apart
  unsigned gbuffer_dispatches = 0;  // counted while a frame of the paper's size is recorded
  unsigned rsm_dispatches = 0;
  size_t own_lines = 0;     // in the method's folder
  size_t shared_lines = 0;  // of harness/method and harness/shaders that it includes, the contract left out
  std::set<std::string> own_files, shared_files;
  std::optional<PublishedCodeSize> published;
};

// With the default parameters, at 1920×1088 and RSM 512², N = 1024 and 2048 on the G-buffer [MFIS16 §5].
// Throws Error(config) where the sources are not there (an installed folder holds none of the host code).
CodeSize code_size(Device& device, const std::string& method);

// Lines that hold more than blanks and comments. `text` is C++ or GLSL.
size_t count_lines(const std::string& text);

// `file` and what it includes, recursively, as far as `resolve` finds it; a header brings the .cpp beside it.
std::set<std::filesystem::path> include_closure(const std::filesystem::path& file,
                                                const std::vector<std::filesystem::path>& include_dirs);

std::string code_size_table(const std::vector<CodeSize>& sizes);
Json to_json(const CodeSize& size);

}  // namespace vsglbench
