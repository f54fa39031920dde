#include "base/log.h"

#include <unistd.h>

#include <cstdio>

#include "base/printable.h"

namespace vsglbench {
namespace {
LogLevel current = LogLevel::normal;
}

void set_log_level(LogLevel level) { current = level; }

void log_line(LogLevel level, const std::string& prefix, const std::string& message) {
  if (level > current) return;
  // A progress bar may stand on the line: clear it first.
  const char* clear = ::isatty(STDERR_FILENO) ? "\r\x1b[K" : "";
  // Not fmt::print: a stderr that takes nothing more is no reason to stop.
  std::fputs(fmt::format("{}{}{}\n", clear, prefix, printable(message)).c_str(), stderr);
}

}  // namespace vsglbench
