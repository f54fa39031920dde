// Files for the targets, whose readers take paths.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace vsglbench::fuzz {

// A folder of this process in the system's folder for temporary files. It is also the data folder (with
// harness/ and scenes/ of the real one) and the cache. It is removed as the process exits; libFuzzer ends
// without an exit where it found something, and ci/fuzz removes what is left then.
const std::filesystem::path& folder();

// folder()/NAME with these bytes.
std::filesystem::path write_input(const std::string& name, std::span<const uint8_t> bytes);

// False where `read` throws Error.
bool accepts(const std::function<void()>& read);

}  // namespace vsglbench::fuzz
