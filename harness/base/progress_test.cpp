#include "base/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <thread>

#include "base/log.h"

namespace vsglbench {
namespace {

// What a pipe gets while `steps` of ten are done, each in `step_ms`.
std::string piped(uint64_t steps, int step_ms, double line_every_s) {
  testing::internal::CaptureStderr();
  {
    Progress progress("cornell/mfis", 10, line_every_s);
    for (uint64_t i = 0; i < steps; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(step_ms));
      progress.advance();
    }
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, APipeGetsALineNowAndThen) {
  EXPECT_EQ(piped(1, 100, 0.05), "10 %, 1 s left: cornell/mfis\n");
  EXPECT_EQ(piped(2, 1, 0), "10 %, 0 s left: cornell/mfis\n20 %, 0 s left: cornell/mfis\n");
  EXPECT_EQ(piped(10, 1, 10), "");
}

// What a terminal of so many columns gets while a bar is drawn and a line logged.
std::string on_terminal(unsigned short columns, const char* term) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_EQ(::grantpt(master), 0);
  EXPECT_EQ(::unlockpt(master), 0);
  const int slave = ::open(::ptsname(master), O_RDWR | O_NOCTTY);
  const winsize size{24, columns, 0, 0};
  EXPECT_EQ(::ioctl(slave, TIOCSWINSZ, &size), 0);
  const char* old = std::getenv("TERM");
  const std::optional<std::string> before = old ? std::optional<std::string>(old) : std::nullopt;
  ::setenv("TERM", term, 1);
  std::fflush(stderr);
  const int kept = ::dup(STDERR_FILENO);
  ::dup2(slave, STDERR_FILENO);
  {
    Progress progress("a label that is longer than the line is wide \x1b[2J", 10);
    progress.advance(5);
    log_warning("one line");
  }
  std::fflush(stderr);
  ::dup2(kept, STDERR_FILENO);
  before ? ::setenv("TERM", before->c_str(), 1) : ::unsetenv("TERM");
  std::string out(4096, '\0');
  const ssize_t n = ::read(master, out.data(), out.size());
  for (const int fd : {master, slave, kept}) ::close(fd);
  out.resize(static_cast<size_t>(std::max<ssize_t>(n, 0)));
  return out;
}

TEST(Progress, ABarIsCutToTheTerminal) {
  const std::string bar = "\r\x1b[K[===============               ]  50";
  EXPECT_EQ(on_terminal(37, "xterm").substr(0, bar.size() + 2), bar + "\r\x1b");
  EXPECT_NE(on_terminal(200, "xterm").find("wide \\x1b[2J\r"), std::string::npos)
      << "nothing of a label steers";
  EXPECT_EQ(progress_bar(0.5, "", "äöü", 43), "[===============               ]  50 %  äö");
  EXPECT_EQ(progress_bar(0, "", "x", 0), "");
}

TEST(Progress, ADumbTerminalGetsMessagesAlone) {
  EXPECT_EQ(on_terminal(80, "dumb"), "warning: one line\r\n");
}

}  // namespace
}  // namespace vsglbench
