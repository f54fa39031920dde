// Messages for the person at the terminal, on stderr: one line each.
#pragma once

#include <fmt/format.h>

#include <string>

namespace vsglbench {

enum class LogLevel { quiet, normal, verbose };
void set_log_level(LogLevel level);

void log_line(LogLevel level, const std::string& prefix, const std::string& message);

template <class... Args>
void log_info(fmt::format_string<Args...> f, Args&&... args) {
  log_line(LogLevel::normal, "", fmt::format(f, std::forward<Args>(args)...));
}
template <class... Args>
void log_debug(fmt::format_string<Args...> f, Args&&... args) {
  log_line(LogLevel::verbose, "", fmt::format(f, std::forward<Args>(args)...));
}
template <class... Args>
void log_warning(fmt::format_string<Args...> f, Args&&... args) {
  log_line(LogLevel::quiet, "warning: ", fmt::format(f, std::forward<Args>(args)...));
}

}  // namespace vsglbench
