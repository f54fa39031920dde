// The one exception type of the project and the exit codes it maps to.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace vsglbench {

// What went wrong, as a user sees it. The value is the exit code of the command (README, "Exit codes").
enum class ErrorKind {
  case_failed = 1,  // one case could not be measured; the others go on
  usage = 2,        // the command line
  config = 2,       // an experiment file
  scene = 2,        // a scene description, geometry or texture
  plugin = 2,       // a method that can't be loaded
  output = 2,       // a folder or file that can't be written
  device = 3,       // no usable Vulkan device, or it was lost
};

// One line: what was wrong, where, what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }

 private:
  ErrorKind kind_;
};

// throw fail(ErrorKind::scene, "{}: no triangles", path);
template <class... Args>
Error fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  return Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace vsglbench
