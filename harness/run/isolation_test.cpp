// Cases that crash, hang, end their process or lose the device: each costs itself and nothing else.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "run/run_fixture.h"
#include "run/runner.h"
#include "run/scene_workers.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

const std::string kVpl = "cornell/vpl/N=16,rsm=16,vis=exact", kFis = "cornell/fis/N=16,rsm=16,vis=exact",
                  kMfis = "cornell/mfis/N=16,rsm=16,vis=exact";

void crash() {
  std::signal(SIGSEGV, SIG_DFL);
  std::raise(SIGSEGV);
}
void lose_device() { throw fail(ErrorKind::device_lost, "Vulkan: the device was lost (code -4) in a test"); }

class IsolationTest : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    config_["methods"] = {{{"method", "vpl"}}, {{"method", "fis"}}, {{"method", "mfis"}}};
  }

  // Every action of every worker is kept in a file, then `misdeed` is done at this action of this case.
  RunOutcome run(const std::string& id = "", const std::string& action = "",
                 const std::function<void()>& misdeed = {}, double time_limit_s = 0) {
    RunOptions options;
    options.config = write_config();
    options.out = out_;
    options.argv = {"vsglbench", "run"};
    options.time_limit_s = time_limit_s;
    const fs::path diary = folder_ / "diary";
    options.sabotage = [=, this](const Activity& a) {
      std::ofstream(diary, std::ios::app) << a.case_id << " | " << a.action << '\n';
      if (inspect_) inspect_();
      if (misdeed && a.case_id == id && a.action == action) misdeed();
    };
    return run_config(options);
  }
  // How often an action began, in all workers together. Exact visibility interrupts the limit, not the
  // action.
  long began(const std::string& id, const std::string& action) const {
    const std::string text = read_text(folder_ / "diary"), line = id + " | " + action + "\n";
    long count = 0;
    for (size_t at = 0; (at = text.find(line, at)) != std::string::npos; at += line.size()) ++count;
    return count;
  }

  Report report() const { return read_report(out_ / "report.json"); }
  const CaseResult& find(const Report& r, const std::string& id) const {
    return *std::find_if(r.cases.begin(), r.cases.end(), [&](const CaseResult& c) { return c.id == id; });
  }

  // fis failed as told; vpl and mfis have their numbers and their images; the A/A pair is of one of them.
  void expect_only_fis_failed(const RunOutcome& outcome, ErrorKind kind,
                              const std::vector<std::string>& parts) {
    EXPECT_EQ(outcome.exit_code, 1);
    expect_sound(out_ / "report.json");
    const Report r = report();
    EXPECT_TRUE(r.complete);
    ASSERT_EQ(r.cases.size(), 3u);
    EXPECT_EQ(r.cases[0].id, kVpl);  // in the order of the experiment
    EXPECT_EQ(r.cases[1].id, kFis);
    EXPECT_EQ(r.cases[2].id, kMfis);
    EXPECT_EQ(r.cases[1].status, Status::failed);
    EXPECT_EQ(r.cases[1].error->kind, kind);
    for (const auto& part : parts) EXPECT_TRUE(contains(r.cases[1].error->message, part));
    for (const size_t i : {0, 2}) {
      ASSERT_EQ(r.cases[i].status, Status::ok) << r.cases[i].error->message;
      EXPECT_EQ(r.cases[i].stopping->frames, 2u);
      for (const char* image : {"indirect", "reference", "error"})
        EXPECT_TRUE(fs::exists(out_ / r.cases[i].images.at(image))) << image;
    }
    ASSERT_EQ(r.scenes.size(), 1u);
    EXPECT_TRUE(fs::exists(out_ / r.scenes[0].contact));
    EXPECT_TRUE(fs::exists(out_ / "images/cornell/direct.exr"));
    ASSERT_EQ(r.aa.size(), 1u);
    EXPECT_NE(r.aa[0].case_id, kFis);
  }

  std::function<void()> inspect_;
};

TEST_F(IsolationTest, ACrashCostsItsOwnCase) {
  for (const char* action : {"opening", "warm-up", "frame 1", "frame 2", "closing"}) {
    SCOPED_TRACE(action);
    fs::remove_all(out_);
    expect_only_fis_failed(run(kFis, action, crash), ErrorKind::crashed, {"signal 11", action});
    EXPECT_GT(report().wall.device_s, 0);
  }
}

TEST_F(IsolationTest, AHangIsStoppedAtTheLimit) {
  const auto hang = [] {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  };
  expect_only_fis_failed(run(kFis, "frame 2", hang, 12), ErrorKind::timeout, {"12 s", "frame 2"});
}

TEST_F(IsolationTest, ALostDeviceIsOpenedAnew) {
  expect_only_fis_failed(run(kFis, "frame 1", lose_device), ErrorKind::device_lost,
                         {"the device was lost (code -4)", "frame 1"});
}

TEST_F(IsolationTest, EndingTheProcessIsACrashWhateverTheCode) {
  expect_only_fis_failed(run(kFis, "frame 1", [] { ::_exit(0); }), ErrorKind::crashed,
                         {"exit code 0", "frame 1"});
  fs::remove_all(out_);
  expect_only_fis_failed(run(kFis, "warm-up", [] { throw 42; }), ErrorKind::crashed,
                         {"exception", "warm-up"});
}

// An exception is no crash: the same worker goes on, and every frame is rendered once.
TEST_F(IsolationTest, AnExceptionNeedsNoNewWorker) {
  const auto misdeed = [] { throw fail(ErrorKind::case_failed, "this method gives up"); };
  expect_only_fis_failed(run(kFis, "frame 2", misdeed), ErrorKind::case_failed, {"this method gives up"});
  EXPECT_EQ(began("", "loading the scene"), 1);
}

// The last to be closed takes its worker down: what the others have is kept, and only the sheet is drawn
// anew.
TEST_F(IsolationTest, WhatWasFinishedIsNotMeasuredAgain) {
  EXPECT_EQ(run(kMfis, "closing", crash).exit_code, 1);
  EXPECT_EQ(began("", "loading the scene"), 2);
  EXPECT_EQ(began(kVpl, "opening"), 1);
  EXPECT_EQ(began(kFis, "opening"), 1);
  const Report r = report();
  EXPECT_EQ(find(r, kVpl).status, Status::ok);
  EXPECT_EQ(find(r, kFis).status, Status::ok);
  EXPECT_EQ(find(r, kMfis).error->kind, ErrorKind::crashed);
  EXPECT_TRUE(fs::exists(out_ / r.scenes.at(0).contact));
  expect_sound(out_ / "report.json");
}

TEST_F(IsolationTest, EveryCaseMayCrashAndTheRunEnds) {
  config_["scenes"] = {"cornell", "ring514"};
  RunOptions options;
  options.config = write_config();
  options.out = out_;
  options.argv = {"vsglbench", "run"};
  options.sabotage = [](const Activity& a) {
    if (a.case_id.starts_with("cornell") && a.action == "opening") crash();
  };
  EXPECT_EQ(run_config(options).exit_code, 1);
  const Report r = report();
  EXPECT_TRUE(r.complete);
  ASSERT_EQ(r.cases.size(), 6u);
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(r.cases[i].status, i < 3 ? Status::failed : Status::ok);
  ASSERT_EQ(r.aa.size(), 1u);
  EXPECT_EQ(r.aa[0].scene, "ring514");
  expect_sound(out_ / "report.json");
}

TEST_F(IsolationTest, ATwinThatCrashesCostsThePair) {
  EXPECT_EQ(run(twin_id(kVpl), "frame 1", crash).exit_code, 0);
  const Report r = report();
  EXPECT_TRUE(r.aa.empty());
  for (const auto& c : r.cases) EXPECT_EQ(c.status, Status::ok) << c.id;
  ASSERT_EQ(r.scenes.at(0).warnings.size(), 1u);
  for (const char* part : {"and with it the A/A pair", "signal 11", "frame 1"})
    EXPECT_TRUE(contains(r.scenes[0].warnings[0], part));
  expect_sound(out_ / "report.json");
}

TEST_F(IsolationTest, ACrashOfTheHarnessFailsWhatIsLeftOfTheScene) {
  EXPECT_EQ(run("", "loading the scene", crash).exit_code, 1);
  EXPECT_EQ(began("", "loading the scene"), 1);
  for (const auto& c : report().cases) {
    EXPECT_EQ(c.error->kind, ErrorKind::crashed);
    EXPECT_TRUE(contains(c.error->message, "loading the scene"));
  }
  fs::remove_all(out_);
  EXPECT_EQ(run("", "drawing the contact sheet", crash).exit_code, 0);  // all have their numbers by then
  for (const auto& c : report().cases) EXPECT_EQ(c.status, Status::ok);
  EXPECT_TRUE(report().scenes.at(0).contact.empty());
  ASSERT_EQ(report().scenes[0].warnings.size(), 1u);
  EXPECT_TRUE(contains(report().scenes[0].warnings[0], "drawing the contact sheet"));
}

// What the others had shown when a worker died is gone on with: no seed is rendered twice.
TEST_F(IsolationTest, AfterACrashNothingIsLookedAtAgain) {
  EXPECT_EQ(run(kFis, "frame 2", crash).exit_code, 1);
  EXPECT_EQ(began("", "loading the scene"), 2);
  EXPECT_EQ(began(kVpl, "opening"), 1);  // had all its frames
  EXPECT_EQ(began(kMfis, "opening"), 2);
  for (const std::string& id : {kVpl, kMfis}) {
    EXPECT_EQ(began(id, "seed 0"), began(kFis, "seed 0")) << id;
    EXPECT_EQ(began(id, "frame 1"), 1) << id;
  }
}

TEST_F(IsolationTest, NoDeviceForANewWorkerFailsTheRest) {
  const Config config = load_config(write_config());
  WorkerOptions options{.scenes = {data_root() / "scenes", {}}, .out = out_};
  options.sabotage = [](const Activity& a) {
    if (a.case_id == kFis) crash();
  };
  EXPECT_FALSE(probe_device(options).name.empty());
  SceneOutcome outcome;
  WorkerLog log;
  const auto remove_driver = [&](const Json& news) {
    if (!news.contains("case")) return;
    for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"})
      ::setenv(name, (folder_ / "absent.json").c_str(), 1);
  };
  run_scene_in_workers("cornell", config, config.cases, true, options, remove_driver, &outcome, &log);
  EXPECT_THROW(probe_device(options), Error);
  for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) ::unsetenv(name);
  EXPECT_TRUE(contains(log.device_gone, "Vulkan"));
  sort_like(config.cases, &outcome.cases);
  ASSERT_EQ(outcome.cases.size(), 3u);
  EXPECT_EQ(outcome.cases[1].error->kind, ErrorKind::crashed);
  for (const size_t i : {0, 2}) EXPECT_EQ(outcome.cases[i].error->kind, ErrorKind::device);
}

// A worker that outlives the parent by a moment must not keep the next run out of the folder.
TEST_F(IsolationTest, AWorkerDoesNotHoldTheFolder) {
  const fs::path held = folder_ / "held";
  inspect_ = [=, this] {
    for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
      std::error_code ec;
      if (fs::equivalent(entry.path(), out_, ec)) std::ofstream(held) << entry.path();
    }
  };
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_FALSE(fs::exists(held));
}

}  // namespace
}  // namespace vsglbench
