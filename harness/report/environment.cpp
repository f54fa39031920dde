#include "report/environment.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "vsglbench_git.h"  // written by git_state.cmake at every build

namespace vsglbench {
namespace {

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t\"");
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t\"\r") - from + 1);
}

// The text after `separator` on the first line that starts with `key`; empty when there is none.
std::string value_of(const char* path, const std::string& key, char separator) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(separator);
    if (line.starts_with(key) && at != std::string::npos) return trimmed(line.substr(at + 1));
  }
  return "";
}

std::string or_unknown(const std::string& text) { return text.empty() ? "unknown" : text; }

}  // namespace

HostInfo host_info() {
  HostInfo host;
  host.cpu = or_unknown(value_of("/proc/cpuinfo", "model name", ':'));
  host.cores = static_cast<uint32_t>(std::max(0L, ::sysconf(_SC_NPROCESSORS_ONLN)));
  host.memory_bytes = static_cast<uint64_t>(std::max(0L, ::sysconf(_SC_PHYS_PAGES))) *
                      static_cast<uint64_t>(std::max(0L, ::sysconf(_SC_PAGESIZE)));
  host.os = or_unknown(value_of("/etc/os-release", "PRETTY_NAME", '='));
  utsname kernel{};
  if (::uname(&kernel) == 0)
    host.os += fmt::format(", {} {} {}", kernel.sysname, kernel.release, kernel.machine);
  return host;
}

std::optional<double> load_average() {
  std::ifstream in("/proc/loadavg");
  double load = 0;
  if (in >> load) return load;
  return std::nullopt;
}

GitState build_git() { return {VSGLBENCH_GIT_COMMIT, VSGLBENCH_GIT_DIRTY}; }

}  // namespace vsglbench
