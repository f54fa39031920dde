#include "base/child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <thread>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

// The pipe to the parent, as a library that looks for it finds it: one that this programme opened to write.
int pipe_to_parent() {
  for (int fd = 1023; fd > 2; --fd) {
    struct stat status {};
    if (::fstat(fd, &status) != 0 || !S_ISFIFO(status.st_mode)) continue;
    const bool own = (::fcntl(fd, F_GETFD) & FD_CLOEXEC) != 0;
    if (own && (::fcntl(fd, F_GETFL) & O_ACCMODE) == O_WRONLY) return fd;
  }
  return -1;
}

void write_bytes(const std::string& bytes) {
  if (::write(pipe_to_parent(), bytes.data(), bytes.size()) < 0) ::_exit(9);
}

bool lives(pid_t pid) {
  char state = 'X';
  if (FILE* file = std::fopen(fmt::format("/proc/{}/stat", pid).c_str(), "r")) {
    if (std::fscanf(file, "%*d (%*[^)]) %c", &state) != 1) state = 'X';
    std::fclose(file);
  }
  return state != 'X' && state != 'Z';
}

// Within the time that a kill takes.
bool dies_soon(pid_t pid) {
  for (int i = 0; i < 500 && lives(pid); ++i) ::usleep(10000);
  return !lives(pid);
}

double seconds_of(const std::function<void()>& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Starts a process that holds the pipe, and tells its number.
void start_grandchild(const ToParent& parent) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    for (;;) ::pause();
  }
  parent.send(pid);
}

TEST(Child, SendsMessagesInOrderAndEnds) {
  Child child([](const ToParent& parent) {
    for (int i = 0; i < 3; ++i) parent.send({{"i", i}, {"text", "a\nb"}});
  });
  for (int i = 0; i < 3; ++i) {
    const auto message = child.receive(kForever);
    ASSERT_TRUE(message);
    EXPECT_EQ((*message)["i"], i);
    EXPECT_EQ((*message)["text"], "a\nb");
  }
  EXPECT_FALSE(child.receive(kForever));
  EXPECT_EQ(child.how_it_ended(), "");
}

TEST(Child, AMessageLargerThanThePipeArrivesWhole) {
  const std::string text(3 << 20, 'x');
  Child child([&](const ToParent& parent) { parent.send(text); });
  EXPECT_EQ(child.receive(kForever), Json(text));
}

TEST(Child, ACrashNamesItsSignalAndKeepsWhatWasSent) {
  Child child([](const ToParent& parent) {
    parent.send(1);
    ::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
  });
  EXPECT_EQ(child.receive(kForever), Json(1));
  EXPECT_FALSE(child.receive(kForever));
  EXPECT_EQ(child.how_it_ended(), "crashed (signal 11, Segmentation fault)");
  EXPECT_FALSE(child.timed_out());
}

TEST(Child, ASilentChildIsKilledAfterItsLimit) {
  Child child([](const ToParent& parent) {
    parent.send(1);
    for (;;) ::pause();
  });
  EXPECT_EQ(child.receive(kForever), Json(1));
  EXPECT_FALSE(child.receive(0.2));
  EXPECT_TRUE(child.timed_out());
  EXPECT_EQ(child.how_it_ended(), "was stopped after 0.2 s without a sign of life");
}

TEST(Child, AnExceptionAndAnExitCodeAreTold) {
  Child thrown([](const ToParent&) { throw fail(ErrorKind::device, "no device"); });
  EXPECT_FALSE(thrown.receive(kForever));
  EXPECT_EQ(thrown.how_it_ended(), "ended with an error: no device");
  Child exited([](const ToParent&) { ::_exit(3); });
  EXPECT_FALSE(exited.receive(kForever));
  EXPECT_EQ(exited.how_it_ended(), "ended the process (exit code 3)");
}

TEST(Child, WhatIsNoMessageEndsItAndNothingElse) {
  for (const char* bytes : {"garbage\n", "{\"forged\":1}\n", "\n", "0123456789abcdef{\"forged\":1}\n",
                            "without an end", "\xff\xfe"}) {
    SCOPED_TRACE(bytes);
    Child child([&](const ToParent& parent) {
      parent.send(1);
      write_bytes(bytes);
      parent.send(2);
      for (;;) ::pause();
    });
    EXPECT_EQ(child.receive(kForever), Json(1));
    EXPECT_FALSE(child.receive(kForever));
    EXPECT_EQ(child.how_it_ended(), "sent what is no message");
    EXPECT_FALSE(child.receive(kForever));
  }
}

TEST(Child, TheEndOfAMessageThatWasCutIsTheEnd) {
  Child child([](const ToParent& parent) {
    std::string text(1 << 20, 'x');  // more than the pipe holds
    ::fcntl(pipe_to_parent(), F_SETFL, O_NONBLOCK);
    parent.send(text);
  });
  std::this_thread::sleep_for(
      std::chrono::milliseconds(300));  // until the pipe is full: who reads along makes room
  EXPECT_FALSE(child.receive(kForever));
  EXPECT_EQ(child.how_it_ended(), "ended the process (exit code 70)");
}

TEST(Child, ThePipeIsFarFromTheDescriptorsThatComeNext) {
  Child child([](const ToParent& parent) { parent.send(pipe_to_parent()); });
  EXPECT_GE(child.receive(kForever)->get<int>(), 200);
}

TEST(Child, OneThatClosedItsPipeIsNotWaitedFor) {
  Child child([](const ToParent&) {
    ::close(pipe_to_parent());
    for (;;) ::pause();
  });
  EXPECT_LT(seconds_of([&] { EXPECT_FALSE(child.receive(kForever)); }), 10);
  EXPECT_EQ(child.how_it_ended(), "closed its pipe and went on");
}

TEST(Child, ItsDeathIsSeenThoughAnotherHoldsThePipe) {
  Child child([](const ToParent& parent) {
    start_grandchild(parent);
    parent.send("last");
    ::raise(SIGKILL);
  });
  const pid_t grandchild = child.receive(kForever)->get<pid_t>();
  EXPECT_EQ(child.receive(kForever), Json("last"));
  EXPECT_LT(seconds_of([&] { EXPECT_FALSE(child.receive(kForever)); }), 10);
  EXPECT_EQ(child.how_it_ended(), "crashed (signal 9, Killed)");
  EXPECT_TRUE(dies_soon(grandchild));
}

TEST(Child, WhatItStartedDiesWithIt) {
  const auto body = [](const ToParent& parent) {
    start_grandchild(parent);
    for (;;) ::pause();
  };
  pid_t grandchild = 0;
  {
    Child child(body);
    grandchild = child.receive(kForever)->get<pid_t>();
    EXPECT_TRUE(lives(grandchild));
  }
  EXPECT_TRUE(dies_soon(grandchild));
  Child another(body);
  grandchild = another.receive(kForever)->get<pid_t>();
  kill_children();
  EXPECT_TRUE(dies_soon(grandchild));
  EXPECT_FALSE(another.receive(kForever));
}

TEST(Child, TheTerminalDoesNotStopIt) {
  Child child([](const ToParent& parent) {
    for (const int signal : {SIGTTOU, SIGTTIN}) ::raise(signal);
    parent.send(::getpgid(0) == ::getpid());
  });
  EXPECT_EQ(child.receive(10), Json(true));
}

}  // namespace
}  // namespace vsglbench
