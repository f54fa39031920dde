#include "base/supervise.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <new>

namespace vsglbench {
namespace {

// A number that a job sends home.
struct Number {
  int value = 0;
};
Json to_json(const Number& n) { return n.value < 0 ? Json("no number") : Json{{"value", n.value}}; }
void from_json(const Json& json, Number* n) { n->value = json.at("value"); }

void crash() {
  ::signal(SIGSEGV, SIG_DFL);
  ::raise(SIGSEGV);
}

// What becomes of five jobs, each of which sends ten times its number and may do harm first.
class Supervise : public testing::Test {
 protected:
  void run(const std::function<void(size_t job)>& harm, const std::function<void()>& opening = {}) {
    supervise<Number>({.name = "test",
                       .jobs = 5,
                       .work =
                           [=](const Worker<Number>& worker, const std::vector<size_t>& left) {
                             if (opening) opening();
                             for (const size_t job : left) {
                               worker.now({job, "counting", 0.5});
                               harm(job);
                               worker.done(job, {static_cast<int>(10 * job)});
                             }
                           },
                       .told = [&](const Number& n) { told_.push_back(n.value); },
                       .lost =
                           [&](size_t job, const End& end) {
                             lost_.push_back(job);
                             kinds_.push_back(end.kind);
                             message_ = end.message();
                           },
                       .died = [&](const End&) { ++deaths_; }});
  }
  void expect_only_third_lost(ErrorKind kind, const std::string& message) {
    EXPECT_EQ(told_, (std::vector{0, 10, 30, 40}));
    EXPECT_EQ(lost_, std::vector<size_t>{2});
    EXPECT_EQ(kinds_, std::vector{kind});
    EXPECT_EQ(message_, message);
    EXPECT_EQ(deaths_, 1);
  }
  void expect_all_lost(ErrorKind kind, const std::string& message) {
    EXPECT_TRUE(told_.empty());
    EXPECT_EQ(lost_, (std::vector<size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(kinds_, std::vector<ErrorKind>(5, kind));
    EXPECT_EQ(message_, message);
  }

  std::vector<int> told_;
  std::vector<size_t> lost_;
  std::vector<ErrorKind> kinds_;
  std::string message_;  // of the last that was lost
  int deaths_ = 0;
};

TEST_F(Supervise, EveryJobIsDoneByOneWorker) {
  run([](size_t) {});
  EXPECT_EQ(told_, (std::vector{0, 10, 20, 30, 40}));
  EXPECT_TRUE(lost_.empty());
  EXPECT_EQ(deaths_, 0);
}

TEST_F(Supervise, AJobThatCrashesCostsItself) {
  run([](size_t job) {
    if (job == 2) crash();
  });
  expect_only_third_lost(ErrorKind::crashed, "crashed (signal 11, Segmentation fault) during counting");
}

TEST_F(Supervise, AJobThatEndsTheProcessCostsItself) {
  run([](size_t job) {
    if (job == 2) ::_exit(0);
  });
  expect_only_third_lost(ErrorKind::crashed, "ended the process (exit code 0) during counting");
}

TEST_F(Supervise, AJobThatHangsIsStopped) {
  run([](size_t job) {
    // NOLINTNEXTLINE(bugprone-infinite-loop): that is what the job is for.
    while (job == 2) ::pause();
  });
  expect_only_third_lost(ErrorKind::timeout,
                         "was stopped after 0.5 s without a sign of life during counting");
}

TEST_F(Supervise, AnErrorKeepsItsKind) {
  run([](size_t job) {
    if (job == 2) throw fail(ErrorKind::device_lost, "the device was lost");
  });
  expect_only_third_lost(ErrorKind::device_lost, "the device was lost during counting");
}

TEST_F(Supervise, AnyOtherExceptionIsACrash) {
  run([](size_t job) {
    if (job == 2) throw std::logic_error("no such light");
  });
  expect_only_third_lost(ErrorKind::crashed, "ended with an error: no such light during counting");
}

TEST_F(Supervise, TooLittleMemoryFailsTheJob) {
  run([](size_t job) {
    if (job == 2) throw std::bad_alloc();
  });
  expect_only_third_lost(ErrorKind::case_failed, "out of memory; make it smaller during counting");
}

TEST_F(Supervise, EveryJobMayCrash) {
  run([](size_t) { crash(); });
  EXPECT_EQ(lost_, (std::vector<size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(deaths_, 5);
}

TEST_F(Supervise, WhatEndsAtNoJobLosesAllThatAreLeft) {
  run([](size_t) {}, [] { throw fail(ErrorKind::device, "no device"); });
  expect_all_lost(ErrorKind::device, "no device during starting");
}

TEST_F(Supervise, AWorkerThatCrashesAtOnceIsStartedOnceMore) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], "x", 1), 1);
  ::close(ends[1]);
  const auto first_crashes = [&] {
    char byte = 0;
    if (::read(ends[0], &byte, 1) == 1) crash();
  };
  run([](size_t) {}, first_crashes);
  EXPECT_EQ(told_.size(), 5u);
  EXPECT_EQ(deaths_, 0);
  ::close(ends[0]);
  told_.clear();
  run([](size_t) {}, crash);
  expect_all_lost(ErrorKind::crashed, "crashed (signal 11, Segmentation fault) during starting");
  EXPECT_EQ(deaths_, 1);
}

// In any order, and what is left out by a worker that ends well is lost.
TEST_F(Supervise, WhatIsLeftOutIsLost) {
  supervise<Number>({.name = "test",
                     .jobs = 3,
                     .work =
                         [](const Worker<Number>& worker, const std::vector<size_t>&) {
                           worker.done(2);
                           worker.tell({7});
                           worker.done(0, {8});
                         },
                     .told = [&](const Number& n) { told_.push_back(n.value); },
                     .lost =
                         [&](size_t job, const End& end) {
                           lost_.push_back(job);
                           kinds_.push_back(end.kind);
                         }});
  EXPECT_EQ(told_, (std::vector{7, 8}));
  EXPECT_EQ(lost_, std::vector<size_t>{1});
  EXPECT_EQ(kinds_, std::vector{ErrorKind::internal});
}

TEST_F(Supervise, AMessageOfAnotherTypeEndsTheWorker) {
  supervise<Number>({.name = "test",
                     .jobs = 2,
                     .work =
                         [](const Worker<Number>& worker, const std::vector<size_t>& left) {
                           worker.now({left.front(), "lying"});
                           worker.done(left.front(), {-1});
                           for (;;) ::pause();
                         },
                     .told = [&](const Number& n) { told_.push_back(n.value); },
                     .lost =
                         [&](size_t job, const End& end) {
                           lost_.push_back(job);
                           message_ = end.message();
                         }});
  EXPECT_TRUE(told_.empty());
  EXPECT_EQ(lost_, (std::vector<size_t>{0, 1}));
  EXPECT_EQ(message_, "sent what is no message during lying");
}

TEST_F(Supervise, WhatTheCallerThrowsEndsIt) {
  const auto work = [](const Worker<Number>& worker, const std::vector<size_t>&) {
    worker.tell({1});
    for (;;) ::pause();
  };
  const auto told = [](const Number&) { throw fail(ErrorKind::output, "disk full"); };
  EXPECT_THROW(supervise<Number>({.name = "test", .work = work, .told = told, .lost = {}}), Error);
}

TEST(ErrorKind, NamesAndExitCodesAreOneTable) {
  for (const ErrorKindRow& row : kErrorKinds) EXPECT_EQ(error_kind(name(row.kind)), row.kind);
  EXPECT_FALSE(error_kind("crash"));
  EXPECT_EQ(exit_code(ErrorKind::config), 2);
  EXPECT_EQ(exit_code(ErrorKind::device_lost), 3);
  EXPECT_EQ(exit_code(ErrorKind::timeout), 1);
}

}  // namespace
}  // namespace vsglbench
