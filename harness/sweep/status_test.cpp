#include "sweep/status.h"

#include "sweep/sweep_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class StatusTest : public SweepTest {
 protected:
  static std::vector<std::string> states(const MadeSweep& sweep) {
    std::vector<std::string> out;
    for (const ShardStatus& s : status_of(sweep.folder.root()).shards) out.emplace_back(name(s.state));
    return out;
  }
};

TEST_F(StatusTest, NamesEachShard) {
  const MadeSweep sweep(root_, made_shards("cornell", 6, 2));
  sweep.finish(0);
  sweep.work(1, sweep.report(1));  // all written, not renamed
  sweep.attempt_elsewhere(1, 1, 3);
  sweep.attempt_elsewhere(2, 1, 500);
  Attempt holder;
  const auto ended = AttemptLock::take(sweep.folder.attempts(3), &holder);
  ended->end({"2024-05-01T12:00:00Z", 6, false, "the task's device is another"});
  sweep.finish(4);
  fs::resize_file(sweep.folder.done(4) / "report.json", 10);
  EXPECT_EQ(states(sweep),
            (std::vector<std::string>{"done", "running", "failed", "failed", "failed", "missing"}));
  const SweepStatus status = status_of(root_);
  EXPECT_TRUE(holds(status.shards[1].why, "attempt 1 on n9"));
  EXPECT_TRUE(holds(status.shards[2].why, "no sign of life for"));
  EXPECT_TRUE(holds(status.shards[3].why, "the task's device is another"));
  EXPECT_TRUE(holds(status.shards[4].why, "00004: its report.json has 10 bytes of "));
  EXPECT_EQ(status.open(), (std::vector<size_t>{2, 3, 4, 5}));
  EXPECT_EQ(status.exit_code(), 5);
  const std::string text = status_text(status);
  EXPECT_TRUE(holds(text, "made: 6 shards: 1 done, 1 running, 3 failed, 1 missing; about 50 s left"));
  EXPECT_TRUE(holds(text, "2 cases of 12 measured, 0 of them failed"));
  EXPECT_TRUE(holds(text, "00005 missing cornell\n"));
}

// A task that was killed leaves nothing that counts, whenever it is.
TEST_F(StatusTest, HalfWrittenShardsAreNotDone) {
  const MadeSweep sweep(root_, made_shards("cornell", 1, 2));
  EXPECT_EQ(states(sweep), std::vector<std::string>{"missing"});
  const fs::path work = sweep.folder.work(0, 1);
  write_text(work / "report.journal", "{}");
  EXPECT_EQ(states(sweep), std::vector<std::string>{"missing"});
  sweep.work(0, sweep.report(0));
  EXPECT_EQ(states(sweep), std::vector<std::string>{"missing"});
  // Names that somebody might take for a shard's.
  fs::rename(work, root_ / "shards" / "00000.tmp");
  EXPECT_EQ(states(sweep), std::vector<std::string>{"missing"});
  fs::rename(root_ / "shards" / "00000.tmp", sweep.folder.done(0));
  EXPECT_EQ(states(sweep), std::vector<std::string>{"done"});
  EXPECT_EQ(status_of(root_).exit_code(), 0);
}

TEST_F(StatusTest, CasesThatFailedAreCounted) {
  const MadeSweep sweep(root_, made_shards("cornell", 2, 2));
  sweep.finish(0);
  Report report = sweep.report(1);
  report.cases[1] = synthetic_failure(report.cases[1].id, Status::failed, "a NaN");
  sweep.finish(1, report);
  const SweepStatus status = status_of(root_);
  EXPECT_EQ(status.exit_code(), 1);
  EXPECT_TRUE(status.open().empty());
  EXPECT_TRUE(holds(status_text(status), "00001 done    cornell: 1 of 2 cases failed"));
}

TEST_F(StatusTest, OtherClassesOfDevicesAreNamedAndCanBeRunAgain) {
  const MadeSweep sweep(root_, made_shards("cornell", 3, 1));
  sweep.finish(0);
  Report other = sweep.report(1);
  other.device.name = "another GPU";
  sweep.finish(1, other);
  const SweepStatus status = status_of(root_);
  Attempt holder;
  AttemptLock::take(sweep.folder.attempts(1), &holder)->end({"", 6, false, "'llvmpipe' is required"});
  EXPECT_TRUE(holds(status_text(status_of(root_)), "00001 done    cornell: attempt 1 on "));
  EXPECT_TRUE(holds(status_text(status), "1 on another GPU, Mesa 22.3.6, subgroup 8"));
  EXPECT_EQ(status.open(), std::vector<size_t>{2});
  EXPECT_EQ(status.open("llvmpipe"), (std::vector<size_t>{1, 2}));

  // Once the others are there on the first device, its cases count, not those that failed on another.
  Report broken = sweep.report(2);
  broken.device.name = "another GPU";
  broken.cases[0] = synthetic_failure(broken.cases[0].id, Status::failed, "a NaN");
  sweep.finish(2, broken, 2);
  EXPECT_EQ(status_of(root_).exit_code(), 1);
  sweep.finish(1, sweep.report(1), 3);
  sweep.finish(2, sweep.report(2), 3);
  EXPECT_EQ(status_of(root_).exit_code(), 0);
  EXPECT_EQ(status_of(root_).cases().failed, 0u);
}

TEST_F(StatusTest, TextOfFilesIsPrintable) {
  const MadeSweep sweep(root_, made_shards("a\x1b[2Jscene", 1, 1));
  Attempt holder;
  AttemptLock::take(sweep.folder.attempts(0), &holder)->end({"", 1, false, "\x1b]0;title\x07 failed"});
  const std::string text = status_text(status_of(root_));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_TRUE(holds(text, "\\x1b]0;title\\x07 failed"));
}

}  // namespace
}  // namespace vsglbench
