#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

namespace vsglbench {

size_t terminal_width() {
  const char* columns = std::getenv("COLUMNS");
  const long said = columns ? std::strtol(columns, nullptr, 10) : 0;
  if (said > 0) return static_cast<size_t>(said);
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace vsglbench
