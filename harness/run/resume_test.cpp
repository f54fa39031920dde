// What an earlier run left in the output folder: gone on with, or kept aside.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "run/run_fixture.h"
#include "run/runner.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class ResumeTest : public RunFixture {
 protected:
  RunOptions options() const {
    RunOptions o;
    o.config = write_config();
    o.out = out_;
    o.argv = {"vsglbench", "run"};
    return o;
  }
  RunOutcome run(bool force = false) {
    RunOptions o = options();
    o.force = force;
    return run_config(o);
  }
  Report report() const { return read_report(out_ / "report.json"); }
};

TEST_F(ResumeTest, ASecondRunKeepsTheEarlierReport) {
  run();
  const std::string before = read_text(out_ / "report.json");
  run();
  EXPECT_EQ(read_text(out_ / "report.previous.json"), before);
  expect_sound(out_ / "report.json");
}

// As an interruption after the first of two scenes leaves it.
TEST_F(ResumeTest, AnInterruptedRunGoesOn) {
  config_["scenes"] = {"cornell", "ring514"};
  run();
  Report stopped = report();
  const double kept = stopped.cases.at(0).frame->span.median, lost = stopped.cases.at(1).frame->span.median;
  stopped.complete = false;
  stopped.cases.pop_back();
  stopped.scenes.pop_back();
  stopped.aa.pop_back();
  write_report(out_ / "report.json", stopped);
  EXPECT_EQ(run().exit_code, 0);
  const Report resumed = report();
  EXPECT_TRUE(resumed.complete);
  ASSERT_EQ(resumed.cases.size(), 2u);
  ASSERT_EQ(resumed.scenes.size(), 2u);
  EXPECT_EQ(resumed.created, stopped.created);
  EXPECT_EQ(resumed.cases[0].frame->span.median, kept);
  EXPECT_NE(resumed.cases[1].frame->span.median, lost);
  ASSERT_EQ(resumed.aa.size(), 2u);  // one a scene; the first scene's as it was
  EXPECT_EQ(part_to_json(resumed.aa[0]), part_to_json(stopped.aa[0]));
  EXPECT_EQ(resumed.aa[1].scene, "ring514");
  EXPECT_GT(resumed.wall.total_s, stopped.wall.total_s);
  EXPECT_FALSE(fs::exists(out_ / "report.previous.json"));
}

TEST_F(ResumeTest, ForceAndAnotherExperimentStartAnewAndLoseNothing) {
  run();
  const std::string complete = read_text(out_ / "report.json");
  run();  // the complete one moves to report.previous.json
  Report stopped = report();
  stopped.complete = false;
  const double measured = stopped.cases.at(0).frame->span.median;
  write_report(out_ / "report.json", stopped);
  run(true);
  EXPECT_NE(report().cases.at(0).frame->span.median, measured);
  EXPECT_EQ(read_report(out_ / "report.incomplete.json").cases.at(0).frame->span.median, measured);
  EXPECT_EQ(read_text(out_ / "report.previous.json"), complete);

  write_report(out_ / "report.json", stopped);
  config_["rsm"] = 8;
  run();
  EXPECT_EQ(report().cases.size(), 1u);
  EXPECT_EQ(report().cases.at(0).parameters.at("rsm"), 8);
}

// Errors in one region and in another under one name would look alike.
TEST_F(ResumeTest, AnotherRegionIsAnotherScene) {
  Json scene = square_scene();
  scene["views"]["front"]["region"] = {0.25, 0.5, 1, 1};
  config_["scenes"] = {write_scene("parted", scene, box_gltf().dump())};
  config_["N"] = {8, 16};
  const auto stop = [&] {
    Report stopped = report();
    stopped.complete = false;
    stopped.cases.pop_back();
    write_report(out_ / "report.json", stopped);
  };
  ASSERT_EQ(run().exit_code, 0);
  stop();
  EXPECT_EQ(run().exit_code, 0);
  stop();
  scene["views"]["front"]["region"] = {0.5, 0.5, 1, 1};
  write_scene("parted", scene, box_gltf().dump());
  EXPECT_NE(run().exit_code, 0);
  ASSERT_EQ(report().cases.size(), 2u);
  EXPECT_TRUE(contains(report().cases[1].error->message, "the scene has changed"));
}

TEST_F(ResumeTest, ADamagedReportIsKeptAside) {
  write_text(out_ / "report.json", "{\"schema\": \"vsgl");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(read_text(out_ / "report.damaged.json"), "{\"schema\": \"vsgl");
}

// A run that has not saved a scene yet has nothing but its journal.
TEST_F(ResumeTest, AJournalThatIsNotGoneOnWithIsKeptAside) {
  const fs::path journal = out_ / "report.journal";
  const auto interrupted = [&] {
    const pid_t pid = ::fork();
    if (pid == 0) {
      RunOptions o = options();
      o.sabotage = [parent = ::getpid()](const Activity& a) {
        if (a.action == "frame 2") ::kill(parent, SIGKILL);
      };
      ::_exit(run_config(o).exit_code);
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_FALSE(fs::exists(out_ / "report.json"));
  };
  interrupted();
  const std::string text = read_text(journal), header = text.substr(0, text.find('\n'));
  ASSERT_GT(text.size(), header.size() + 1);

  config_["rsm"] = 8;
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run().exit_code, 0);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_TRUE(contains(said,
                       "report.journal: of a run that is not gone on with; it is kept as "
                       "report.incomplete.journal"));
  EXPECT_EQ(read_text(out_ / "report.incomplete.journal"), text);

  // Put back, it is gone on with.
  config_["rsm"] = 16;
  fs::rename(out_ / "report.incomplete.journal", journal);
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(report().created, report_from_json(Json::parse(header)["about"]).created);
  EXPECT_FALSE(fs::exists(journal));
  EXPECT_FALSE(fs::exists(out_ / "report.incomplete.journal"));

  const std::string damaged = text.substr(header.size() / 2);
  write_text(journal, damaged);
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_TRUE(contains(::testing::internal::GetCapturedStderr(),
                       "report.journal: its first line is damaged; it is kept as report.damaged.journal"));
  EXPECT_EQ(read_text(out_ / "report.damaged.journal"), damaged);
}

}  // namespace
}  // namespace vsglbench
