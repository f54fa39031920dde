#include "fuzz/input.h"

#include <stdlib.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "base/error.h"
#include "base/file.h"

namespace fs = std::filesystem;

namespace vsglbench::fuzz {
namespace {

struct Folder {
  Folder() {
    std::string pattern = fs::temp_directory_path() / "vsglbench-fuzz-XXXXXX";
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder for the inputs");
    path = pattern;
    owner = ::getpid();
    for (const char* name : {"harness", "scenes"}) fs::create_symlink(data_root() / name, path / name);
    fs::create_directories(path / "configs" / "presets");
    fs::create_directories(path / "references");
    ::setenv("VSGLBENCH_ROOT", path.c_str(), 1);
    ::setenv("VSGLBENCH_CACHE", path.c_str(), 1);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ec;
    if (owner == ::getpid()) fs::remove_all(path, ec);
  }
  fs::path path;
  pid_t owner = 0;
};

}  // namespace

const fs::path& folder() {
  static const Folder made;
  return made.path;
}

fs::path write_input(const std::string& name, std::span<const uint8_t> bytes) {
  fs::path path = folder() / name;
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error("an input can't be written");
  return path;
}

bool accepts(const std::function<void()>& read) {
  try {
    read();
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace vsglbench::fuzz
