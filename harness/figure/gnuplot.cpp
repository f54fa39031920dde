#include "figure/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "image/font.h"

namespace vsglbench {
namespace {

// An unnamed file in memory.
class Scratch {
 public:
  Scratch() : file_(::memfd_create("gnuplot", MFD_CLOEXEC)) {
    if (file_ < 0)
      throw fail(ErrorKind::output, "gnuplot: no memory for its script: {}", std::strerror(errno));
  }
  ~Scratch() { ::close(file_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  int file() const { return file_; }
  void write(const std::string& text) const {
    for (size_t at = 0; at < text.size();) {
      const ssize_t n = ::pwrite(file_, text.data() + at, text.size() - at, static_cast<off_t>(at));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0)
        throw fail(ErrorKind::output, "gnuplot: no memory for its script: {}", std::strerror(errno));
      at += static_cast<size_t>(n);
    }
  }
  std::string read() const {
    std::string text;
    char part[65536];
    while (true) {
      const ssize_t n = ::pread(file_, part, sizeof part, static_cast<off_t>(text.size()));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return text;
      text.append(part, static_cast<size_t>(n));
    }
  }

 private:
  int file_;
};

struct Ended {
  int status;  // of waitpid
  std::string out, err;
};

Ended execute(const std::string& script) {
  const Scratch in, out, err;
  in.write(script);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.file(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.file(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.file(), STDERR_FILENO);
  // Without what the user's .gnuplot says; from standard input.
  char name[] = "gnuplot", defaults[] = "-d", input[] = "-";
  char* arguments[] = {name, defaults, input, nullptr};
  pid_t pid = 0;
  const int refused = ::posix_spawnp(&pid, name, &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  if (refused == ENOENT)
    throw fail(ErrorKind::output,
               "gnuplot, which draws plots, is not installed; install the package gnuplot-nox");
  if (refused != 0) throw fail(ErrorKind::output, "gnuplot can't be started: {}", std::strerror(refused));
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return {status, out.read(), err.read()};
}

// The last line of what it said, where the reason stands, without the margin.
std::string last_line(const std::string& text) {
  const size_t end = text.find_last_not_of(" \n\r\t");
  if (end == std::string::npos) return "";
  const size_t before = text.rfind('\n', end),
               begin = text.find_first_not_of(" \n\t", before == text.npos ? 0 : before);
  return text.substr(begin, end + 1 - begin);
}

}  // namespace

Gnuplot::Gnuplot() : version_(run("set print '-'\nprint GPVAL_VERSION\n")) {
  while (!version_.empty() && version_.back() == '\n') version_.pop_back();
}

std::string Gnuplot::run(const std::string& script) const {
  const Ended ended = execute(script);
  if (WIFSIGNALED(ended.status))
    throw fail(ErrorKind::output, "gnuplot: it was ended by signal {}", WTERMSIG(ended.status));
  if (WEXITSTATUS(ended.status) != 0) {
    const std::string reason = last_line(ended.err);
    throw fail(ErrorKind::output, "gnuplot: {}",
               reason.empty() ? fmt::format("it ended with code {}", WEXITSTATUS(ended.status)) : reason);
  }
  return ended.out;
}

std::string Gnuplot::quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : drawable(text)) out += c == '\'' ? "’" : std::string(1, c);
  return out + "'";
}

}  // namespace vsglbench
