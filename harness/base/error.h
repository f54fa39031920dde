// The one exception type of the project, and the exit codes that it maps to.
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace vsglbench {

// What went wrong, as a user sees it: an exit code of the command (README, "Exit codes") and, of a case, the
// `error.kind` of its report.
enum class ErrorKind {
  // what the user gave
  usage,          // the command line
  config,         // an experiment file
  scene,          // a scene description, geometry or texture
  asset_missing,  // a scene's geometry that is not on this machine; its cases are skipped
  plugin,         // a method that can't be loaded, or whose code can't be used
  output,         // a folder or file that can't be written
  // the device
  device,       // none that can be opened
  device_lost,  // one that was open failed
  // a case; the others go on
  case_failed,  // it could not be measured
  not_finite,   // a NaN or an Inf in its lights or pixels
  refused,      // lights that can't be: not written, of power from nothing, written past their end
  internal,     // an exception that is no Error
  crashed,      // its process ended
  timeout,      // its process was silent for too long
};

struct ErrorKindRow {
  ErrorKind kind;
  std::string_view name;  // in a report
  int exit_code;
};
inline constexpr std::array kErrorKinds = {
    ErrorKindRow{ErrorKind::usage, "usage", 2},
    ErrorKindRow{ErrorKind::config, "config", 2},
    ErrorKindRow{ErrorKind::scene, "scene", 2},
    ErrorKindRow{ErrorKind::asset_missing, "asset_missing", 2},
    ErrorKindRow{ErrorKind::plugin, "plugin", 2},
    ErrorKindRow{ErrorKind::output, "output", 2},
    ErrorKindRow{ErrorKind::device, "device", 3},
    ErrorKindRow{ErrorKind::device_lost, "device_lost", 3},
    ErrorKindRow{ErrorKind::case_failed, "case_failed", 1},
    ErrorKindRow{ErrorKind::not_finite, "not_finite", 1},
    ErrorKindRow{ErrorKind::refused, "refused", 1},
    ErrorKindRow{ErrorKind::internal, "internal", 1},
    ErrorKindRow{ErrorKind::crashed, "crashed", 1},
    ErrorKindRow{ErrorKind::timeout, "timeout", 1},
};

// The table stands in the order of the enum.
constexpr const ErrorKindRow& row_of(ErrorKind kind) { return kErrorKinds.at(static_cast<size_t>(kind)); }
static_assert([] {
  for (size_t i = 0; i < kErrorKinds.size(); ++i)
    if (kErrorKinds[i].kind != static_cast<ErrorKind>(i)) return false;
  return kErrorKinds.back().kind == ErrorKind::timeout;
}());

constexpr std::string_view name(ErrorKind kind) { return row_of(kind).name; }
constexpr int exit_code(ErrorKind kind) { return row_of(kind).exit_code; }
// Nothing for what is no kind's name.
constexpr std::optional<ErrorKind> error_kind(std::string_view name) {
  for (const ErrorKindRow& row : kErrorKinds)
    if (row.name == name) return row.kind;
  return std::nullopt;
}

// One line: what was wrong, where, what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }
  int exit_code() const { return vsglbench::exit_code(kind_); }

 private:
  ErrorKind kind_;
};

// throw fail(ErrorKind::scene, "{}: no triangles", path);
template <class... Args>
Error fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  return Error(kind, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace vsglbench
