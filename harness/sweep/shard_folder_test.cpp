#include "sweep/shard_folder.h"

#include <functional>

#include "sweep/sweep_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class ShardFolderTest : public SweepTest {
 protected:
  std::vector<FinishedShard> finished(const MadeSweep& sweep, size_t shard = 0) {
    return sweep.folder.finished_of(sweep.plan.hash(), shard);
  }
};

TEST_F(ShardFolderTest, WhatIsBeingWrittenIsNotThere) {
  const MadeSweep sweep(root_, made_shards("cornell", 1, 2));
  sweep.work(0, sweep.report(0));
  EXPECT_TRUE(finished(sweep).empty());
  EXPECT_EQ(sweep.folder.finish(0, 1), sweep.folder.done(0));
  ASSERT_EQ(finished(sweep).size(), 1u);
  EXPECT_EQ(finished(sweep)[0].problem, "");
  EXPECT_EQ(finished(sweep)[0].record.cases.ok, 2u);
  EXPECT_FALSE(fs::exists(sweep.folder.work(0, 1)));
}

TEST_F(ShardFolderTest, TheFirstToFinishCounts) {
  const MadeSweep sweep(root_, made_shards("cornell", 1, 2));
  sweep.work(0, sweep.report(0), 1);
  sweep.work(0, sweep.report(0), 2);
  sweep.work(0, sweep.report(0), 12);
  EXPECT_EQ(sweep.folder.finish(0, 12), sweep.folder.done(0));
  EXPECT_EQ(sweep.folder.finish(0, 2), sweep.folder.done_again(0, 2));
  EXPECT_EQ(sweep.folder.finish(0, 1), sweep.folder.done_again(0, 1));
  std::vector<size_t> attempts;
  for (const FinishedShard& f : finished(sweep)) attempts.push_back(f.record.attempt);
  EXPECT_EQ(attempts, (std::vector<size_t>{12, 1, 2}));
  EXPECT_THROW(sweep.folder.finish(0, 3), Error);  // there is no such work
}

TEST_F(ShardFolderTest, AFolderThatIsNotWholeHasAProblem) {
  const MadeSweep sweep(root_, made_shards("cornell", 4, 1));
  for (size_t i = 0; i < 4; ++i) sweep.finish(i);
  fs::resize_file(sweep.folder.done(0) / "report.json", 100);
  fs::remove(sweep.folder.done(1) / "host.json");
  fs::remove(sweep.folder.done(2) / "report.json");
  EXPECT_TRUE(holds(finished(sweep, 0).at(0).problem, "has 100 bytes of "));
  EXPECT_TRUE(holds(finished(sweep, 1).at(0).problem, "no sound host.json"));
  EXPECT_TRUE(holds(finished(sweep, 2).at(0).problem, "no report.json"));
  EXPECT_TRUE(holds(sweep.folder.finished_of(std::string(32, '0'), 3).at(0).problem, "of another plan"));
  fs::rename(sweep.folder.done(3), sweep.folder.done(2) / "moved");
  fs::remove_all(sweep.folder.done(0));
  fs::rename(sweep.folder.done(2) / "moved", sweep.folder.done(0));
  EXPECT_TRUE(holds(finished(sweep, 0).at(0).problem, "of another plan"));  // of another shard
}

TEST_F(ShardFolderTest, AClassIsNameDriverAndSubgroupSize) {
  const DeviceReport device = synthetic_report().device;
  for (const auto& change : std::vector<std::function<void(DeviceReport&)>>{
           [](DeviceReport& d) { d.name += "x"; }, [](DeviceReport& d) { d.driver += "x"; },
           [](DeviceReport& d) { d.driver_version += "x"; }, [](DeviceReport& d) { d.subgroup_size = 4; },
           [](DeviceReport& d) { d.settings["LP_NUM_THREADS"] = "1"; }}) {
    DeviceReport other = device;
    change(other);
    EXPECT_NE(device_class(other), device_class(device));
    EXPECT_NE(class_folder(other), class_folder(device));
    EXPECT_NE(class_text(other), class_text(device));
  }
  DeviceReport named = device;
  named.name = "a/../b\x1b[2J (c)";
  EXPECT_TRUE(class_folder(named).starts_with("a-..-b-2J-c-"));
}

}  // namespace
}  // namespace vsglbench
