#include "base/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <thread>

#include "base/error.h"

namespace vsglbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kUncaught = 70;            // exit code of a child that an exception ended
constexpr int kFirstDescriptor = 200;    // of the child's pipe: far from what a stray write or close means
constexpr int kGlance_ms = 100;          // between two looks at whether a silent child lives
constexpr double kFarewell_s = 2;        // from the end of the pipe to that of the process
constexpr size_t kMostBytes = 64 << 20;  // of one message

// The process groups that kill_children() ends; 0: none.
std::array<std::atomic<pid_t>, 16> running{};

void replace_running(pid_t from, pid_t to) {
  for (auto& slot : running) {
    pid_t expected = from;
    if (slot.compare_exchange_strong(expected, to)) return;
  }
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string make_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

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

// A child of its own group may not read from the terminal, and is not stopped for writing to it.
void settle_in(pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // never outlives the parent
  if (::getppid() != parent) ::_exit(kUncaught);
  for (const int signal : {SIGPIPE, SIGTTOU, SIGTTIN}) ::signal(signal, SIG_IGN);
}

// The same pipe under a high number, where there is one.
int moved_up(int pipe) {
  const int high = ::fcntl(pipe, F_DUPFD_CLOEXEC, kFirstDescriptor);
  if (high < 0) return pipe;
  ::close(pipe);
  return high;
}

[[noreturn]] void run_child(const std::function<void(const ToParent&)>& body, const ToParent& parent) {
  int code = 0;
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

void kill_children() noexcept {
  for (const auto& slot : running) {
    if (const pid_t group = slot.load(); group > 0) ::kill(-group, SIGKILL);
  }
}

void ToParent::send(const Json& message) const {
  // Bytes that are no UTF-8 (a file name, say) must not end the child.
  const std::string line = token_ + message.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!write_all(pipe_, line)) ::_exit(kUncaught);
}

Child::Child(const std::function<void(const ToParent&)>& body) : token_(make_token()) {
  try {
    start(body);
  } catch (...) {
    if (pipe_ >= 0) ::close(pipe_);
    throw;
  }
}

void Child::start(const std::function<void(const ToParent&)>& body) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw fail(ErrorKind::case_failed, "can't start a process: {}", std::strerror(errno));
  }
  pipe_ = ends[0];
  ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
  std::fflush(nullptr);  // or both would write what is buffered
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    settle_in(parent);
    for (auto& slot : running) slot = 0;  // the parent's children are not the child's
    ::close(ends[0]);
    run_child(body, ToParent(moved_up(ends[1]), token_));
  }
  const int error = errno;
  ::close(ends[1]);
  if (pid_ < 0) throw fail(ErrorKind::case_failed, "can't start a process: {}", std::strerror(error));
  ::setpgid(pid_, pid_);  // here too: whichever comes first
  replace_running(0, pid_);
}

Child::~Child() {
  if (pid_ > 0) stop("");
  if (pipe_ >= 0) ::close(pipe_);
}

// Whether the process has ended; it is not reaped by that, so its group's number stays its own.
bool Child::has_died() const {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

void Child::stop(const std::string& why) {
  if (ended_.empty()) ended_ = why;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
  reap();
}

void Child::reap() {
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  ::kill(-pid_, SIGKILL);  // what it has started
  replace_running(pid_, 0);
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (ended_.empty()) ended_ = describe_status(status);
}

// After the end of the pipe: that of the process follows at once, or never.
void Child::await_death() {
  for (const auto start = Clock::now(); seconds_since(start) < kFarewell_s;) {
    if (has_died()) return reap();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  stop("closed its pipe and went on");
}

// The first message of what was read, if it is whole. Kills the child for what is none.
std::optional<Json> Child::next_received() {
  for (;;) {
    const size_t known = std::min(received_.size(), token_.size());
    const size_t end = received_.find('\n');
    const bool whole = end != std::string::npos;
    Json message;
    if (whole && end >= token_.size()) {
      message = Json::parse(received_.begin() + token_.size(), received_.begin() + end, nullptr, false);
    }
    if (received_.compare(0, known, token_, 0, known) != 0 || received_.size() > kMostBytes ||
        (whole && (end < token_.size() || message.is_discarded()))) {
      received_.clear();
      ended_ = "sent what is no message";
      if (pid_ > 0) stop(ended_);
      ::close(pipe_);  // nothing more is believed
      pipe_ = -1;
      return std::nullopt;
    }
    if (!whole) return std::nullopt;
    received_.erase(0, end + 1);
    if (!message.contains("uncaught") || !message["uncaught"].is_string()) return message;
    ended_ = "ended with an error: " + message["uncaught"].get<std::string>();
  }
}

Child::Pipe Child::read_some() {
  char part[65536];
  const ssize_t n = ::read(pipe_, part, sizeof part);
  if (n > 0) received_.append(part, static_cast<size_t>(n));
  if (n > 0 || (n < 0 && errno == EINTR)) return Pipe::open;
  return n < 0 && errno == EAGAIN ? Pipe::empty : Pipe::closed;
}

std::optional<Json> Child::receive(double silence_s) {
  const auto start = Clock::now();
  for (;;) {
    // 1. What was read already.
    if (auto message = next_received()) return message;
    if (pid_ < 0 && read_some() != Pipe::open) return std::nullopt;
    if (pid_ < 0) continue;
    // 2. What the pipe holds, before any verdict.
    const double left = silence_s - seconds_since(start);
    pollfd wanted{pipe_, POLLIN, 0};
    const int wait_ms = static_cast<int>(std::clamp(left * 1e3 + 1, 0.0, double{kGlance_ms}));
    if (::poll(&wanted, 1, wait_ms) > 0) {
      if (read_some() == Pipe::closed) await_death();
      continue;
    }
    // 3. Silence: of one that has ended while another process holds its pipe, or that hangs.
    if (has_died()) {
      reap();
    } else if (left <= 0) {
      timed_out_ = true;
      stop(fmt::format("was stopped after {:g} s without a sign of life", silence_s));
    }
  }
}

}  // namespace vsglbench
