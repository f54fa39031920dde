#include "base/log.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/printable.h"

namespace vsglbench {
namespace {
LogLevel current = LogLevel::normal;
}

void set_log_level(LogLevel level) { current = level; }

void log_line(LogLevel level, const std::string& prefix, const std::string& message) {
  if (level > current) return;
  // A progress bar may stand on the line: clear it first. A dumb terminal shows none.
  const char* term = std::getenv("TERM");
  const bool dumb = term != nullptr && std::strcmp(term, "dumb") == 0;
  const char* clear = !dumb && ::isatty(STDERR_FILENO) ? "\r\x1b[K" : "";
  // Not fmt::print: a stderr that takes nothing more is no reason to stop.
  std::fputs(fmt::format("{}{}{}\n", clear, prefix, excerpt(message, kLongestMessage)).c_str(), stderr);
}

}  // namespace vsglbench
