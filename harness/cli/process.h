// Tests only: runs the built programme and keeps what it said.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "base/test_folders.h"

namespace vsglbench {

struct Finished {
  int code = -1;   // exit code; -1 when a signal ended it
  int signal = 0;  // 0 when it ended by itself
  std::string out, err;

  // Lines of stderr that report an error.
  std::vector<std::string> errors() const {
    std::vector<std::string> lines;
    for (size_t at = 0; at < err.size();) {
      const size_t end = std::min(err.find('\n', at), err.size());
      const std::string line = err.substr(at, end - at);
      if (line.starts_with("vsglbench: ")) lines.push_back(line);
      at = end + 1;
    }
    return lines;
  }
};

// What the programme may take; 0: all there is.
struct Limits {
  rlim_t file_bytes = 0;                  // of any one file
  rlim_t data_bytes = 0;                  // of memory
  const char* standard_output = nullptr;  // a file instead of the pipe
};

struct RunningProgramme {
  pid_t pid = -1;
  int out = -1, err = -1;  // ends of pipes, which hold more than a test's programme says
};

inline void limit(int resource, rlim_t bytes) {
  const rlimit value{bytes, bytes};
  ::setrlimit(resource, &value);
}

// What counts as data of any process under the address sanitizer, 14 TiB for its shadow, which is never
// filled; as of this process, whose own data are little. 0 without it.
inline rlim_t sanitizer_bytes() {
#ifdef __SANITIZE_ADDRESS__
  std::ifstream status("/proc/self/status");
  rlim_t kib = 0;
  for (std::string word; status >> word;) {
    if (word == "VmData:") status >> kib;
  }
  return kib * 1024;
#else
  return 0;
#endif
}

inline RunningProgramme start(const std::vector<std::string>& arguments, const Limits& limits = {}) {
  std::vector<std::string> all = {test_programme().string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& a : all) argv.push_back(a.data());
  argv.push_back(nullptr);
  const rlim_t sanitizer = sanitizer_bytes();
  int out[2], err[2];
  if (::pipe(out) != 0 || ::pipe(err) != 0) return {};
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(err[1], STDERR_FILENO);
    if (limits.standard_output) ::dup2(::open(limits.standard_output, O_WRONLY), STDOUT_FILENO);
    for (const int end : {out[0], out[1], err[0], err[1]}) ::close(end);
    if (limits.file_bytes > 0) limit(RLIMIT_FSIZE, limits.file_bytes);
    if (limits.data_bytes > 0) limit(RLIMIT_DATA, limits.data_bytes + sanitizer);
    limit(RLIMIT_CORE, 0);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(err[1]);
  return {pid, out[0], err[0]};
}

inline std::string read_to_end(int pipe) {
  std::string text;
  char part[4096];
  for (ssize_t n; (n = ::read(pipe, part, sizeof part)) > 0;) text.append(part, static_cast<size_t>(n));
  ::close(pipe);
  return text;
}

inline Finished finish(const RunningProgramme& child) {
  Finished f;
  f.out = read_to_end(child.out);
  f.err = read_to_end(child.err);
  int status = 0;
  ::waitpid(child.pid, &status, 0);
  if (WIFEXITED(status)) f.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) f.signal = WTERMSIG(status);
  return f;
}

}  // namespace vsglbench
