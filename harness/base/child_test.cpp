#include "base/child.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <limits>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

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

}  // namespace
}  // namespace vsglbench
