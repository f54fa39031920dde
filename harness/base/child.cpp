#include "base/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr int kUncaught = 70;  // exit code of a child that an exception ended

// Writes all of it; false when the other end is closed.
bool write_all(int pipe, const std::string& bytes) {
  for (size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(pipe, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    at += static_cast<size_t>(n);
  }
  return true;
}

[[noreturn]] void run_child(const std::function<void(const ToParent&)>& body, int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // never outlives the parent
  ::signal(SIGPIPE, SIG_IGN);
  int code = 0;
  const ToParent parent(pipe);
  try {
    body(parent);
  } catch (const std::exception& e) {
    parent.send({{"uncaught", e.what()}});
    code = kUncaught;
  } catch (...) {
    parent.send({{"uncaught", "an exception that is no std::exception"}});
    code = kUncaught;
  }
  std::fflush(nullptr);
  ::_exit(code);  // what the parent made is the parent's to clean up
}

std::string describe_status(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("crashed (signal {}, {})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  }
  const int code = WEXITSTATUS(status);
  return code == 0 ? "" : fmt::format("ended the process (exit code {})", code);
}

}  // namespace

void ToParent::send(const Json& message) const {
  // Bytes that are no UTF-8 (a file name, say) must not end the child.
  const std::string line = message.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!write_all(pipe_, line)) ::_exit(kUncaught);
}

Child::Child(const std::function<void(const ToParent&)>& body) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw fail(ErrorKind::case_failed, "can't start a process: {}", std::strerror(errno));
  }
  std::fflush(nullptr);  // or both would write what is buffered
  pid_ = ::fork();
  if (pid_ == 0) {
    ::close(ends[0]);
    run_child(body, ends[1]);
  }
  ::close(ends[1]);
  pipe_ = ends[0];
  if (pid_ < 0) throw fail(ErrorKind::case_failed, "can't start a process: {}", std::strerror(errno));
}

Child::~Child() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    reap();
  }
  if (pipe_ >= 0) ::close(pipe_);
}

void Child::reap() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (ended_.empty()) ended_ = describe_status(status);
}

std::optional<Json> Child::receive(double silence_s) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  for (;;) {
    if (const size_t end = received_.find('\n'); end != std::string::npos) {
      Json message = Json::parse(received_.substr(0, end));
      received_.erase(0, end + 1);
      if (!message.contains("uncaught")) return message;
      ended_ = "ended with an error: " + message["uncaught"].get<std::string>();
      continue;
    }
    if (pid_ < 0) return std::nullopt;
    const double left = silence_s - std::chrono::duration<double>(Clock::now() - start).count();
    if (left <= 0) {
      timed_out_ = true;
      ended_ = fmt::format("was stopped after {:g} s without a sign of life", silence_s);
      ::kill(pid_, SIGKILL);
      reap();
      return std::nullopt;
    }
    pollfd wanted{pipe_, POLLIN, 0};
    if (::poll(&wanted, 1, static_cast<int>(std::min(left * 1e3 + 1, 1e6))) <= 0) continue;
    char part[65536];
    const ssize_t n = ::read(pipe_, part, sizeof part);
    if (n > 0) received_.append(part, static_cast<size_t>(n));
    if (n == 0 || (n < 0 && errno != EINTR)) reap();
  }
}

}  // namespace vsglbench
