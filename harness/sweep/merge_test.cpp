#include "sweep/merge.h"

#include <functional>

#include "sweep/sweep_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class MergeTest : public SweepTest {
 protected:
  MergeOutcome merge() { return merge_sweep(root_); }
  std::string text_of(const MergedClass& c) { return read_text(c.folder / "report.json"); }
  static std::vector<std::string> ids(const Report& report) {
    std::vector<std::string> out;
    for (const CaseResult& c : report.cases) out.push_back(c.id);
    return out;
  }
};

TEST_F(MergeTest, OneReportOfAllShards) {
  std::vector<Shard> shards = made_shards("cornell", 1, 3);
  for (const Shard& s : made_shards("ring", 1, 2)) shards.push_back(s);
  const MadeSweep sweep(root_, shards);
  sweep.finish(1);
  sweep.finish(0);
  const MergeOutcome outcome = merge();
  EXPECT_EQ(outcome.exit_code(), 0);
  ASSERT_EQ(outcome.classes.size(), 1u);
  const Report report = read_report_at(outcome.classes[0].folder);
  EXPECT_EQ(ids(report), sweep.plan.case_ids());
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.config, sweep.plan.config);  // without the shards' choice of cases
  ASSERT_EQ(report.scenes.size(), 2u);
  EXPECT_EQ(report.scenes[0].name, "cornell");
  EXPECT_EQ(report.aa.size(), 2u);
  EXPECT_FALSE(report.analysis.is_null());
  EXPECT_DOUBLE_EQ(report.wall.total_s, 120);
}

TEST_F(MergeTest, DependsOnWhatIsThereAlone) {
  const std::vector<Shard> shards = made_blocks("cornell", 4, 2);
  const auto merged_in = [&](const std::string& name, const std::vector<size_t>& order) {
    const MadeSweep sweep(root_ / name, shards);
    for (const size_t i : order) {
      sweep.finish(i, sweep.report(i, 1 + 0.01 * static_cast<double>(i)));
      merge_sweep(root_ / name);  // also of a part
    }
    const MergeOutcome once = merge_sweep(root_ / name);
    const std::string text = text_of(once.classes.at(0)),
                      list = read_text(root_ / name / "merged/merge.json");
    const MergeOutcome twice = merge_sweep(root_ / name);
    EXPECT_EQ(text, text_of(twice.classes.at(0)));
    EXPECT_EQ(list, read_text(root_ / name / "merged/merge.json"));
    return text;
  };
  EXPECT_EQ(merged_in("a", {0, 1, 2, 3}), merged_in("b", {2, 3, 1, 0}));
}

TEST_F(MergeTest, WhatIsMissingIsMissing) {
  const MadeSweep sweep(root_, made_shards("cornell", 3, 2));
  EXPECT_EQ(merge().exit_code(), 5);  // nothing at all
  sweep.finish(0);
  sweep.finish(2);
  sweep.attempt_elsewhere(1, 1, 500);
  const MergeOutcome outcome = merge();
  EXPECT_EQ(outcome.exit_code(), 5);
  const Report report = read_report_at(outcome.classes.at(0).folder);
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(report.cases.size(), 4u);
  EXPECT_EQ(report.config.at("missing"), Json(sweep.plan.shards[1].cases));
  EXPECT_TRUE(holds(merge_text(outcome), "missing: shard 00001, failed: attempt 1 on n9: no sign of life"));
  const Json list = Json::parse(read_text(root_ / "merged/merge.json"));
  EXPECT_EQ(list.at("missing").at(0).at("shard"), 1);
  sweep.finish(1);
  EXPECT_EQ(merge().exit_code(), 0);
}

TEST_F(MergeTest, FailedCasesAreTold) {
  const MadeSweep sweep(root_, made_shards("cornell", 2, 2));
  sweep.finish(0);
  Report report = sweep.report(1);
  report.cases[0] = synthetic_failure(report.cases[0].id, Status::failed, "a NaN");
  sweep.finish(1, report);
  EXPECT_EQ(merge().exit_code(), 1);
  EXPECT_TRUE(holds(merge_text(merge()), "4 of 4 cases from 2 shards, 1 failed"));
}

TEST_F(MergeTest, NoReportHasTwoClassesOfDevices) {
  const std::vector<std::function<void(DeviceReport&)>> others = {
      [](DeviceReport& d) { d.name = "another"; }, [](DeviceReport& d) { d.driver = "another"; },
      [](DeviceReport& d) { d.subgroup_size = 64; }};
  for (size_t k = 0; k < others.size(); ++k) {
    const fs::path root = root_ / std::to_string(k);
    const MadeSweep sweep(root, made_shards("cornell", 3, 2));
    sweep.finish(0);
    Report other = sweep.report(1);
    others[k](other.device);
    sweep.finish(1, other);
    sweep.finish(2);
    const MergeOutcome outcome = merge_sweep(root);
    EXPECT_EQ(outcome.exit_code(), 5);
    ASSERT_EQ(outcome.classes.size(), 2u);
    EXPECT_EQ(outcome.classes[0].shards.size(), 2u);  // that with more comes first
    EXPECT_EQ(ids(outcome.classes[1].report), sweep.plan.shards[1].cases);
    EXPECT_NE(outcome.classes[0].folder, outcome.classes[1].folder);
    EXPECT_EQ(read_report_at(outcome.classes[1].folder).device.name, other.device.name);
    EXPECT_TRUE(holds(merge_text(outcome), "never in one report"));
    sweep.finish(1, sweep.report(1), 2);  // once more, on the first device
    EXPECT_EQ(merge_sweep(root).exit_code(), 0);
    EXPECT_EQ(merge_sweep(root).classes.size(), 2u);
  }
}

TEST_F(MergeTest, OfTwoTheFirstDoneIsTaken) {
  const MadeSweep sweep(root_, made_shards("cornell", 1, 1));
  Report first = sweep.report(0), second = first;
  first.cases[0].accuracy->pixels = 111;
  second.cases[0].accuracy->pixels = 222;
  sweep.finish(0, first, 5);
  sweep.finish(0, second, 2);
  const MergeOutcome outcome = merge();
  EXPECT_EQ(outcome.exit_code(), 0);
  EXPECT_EQ(outcome.classes.at(0).report.cases.at(0).accuracy->pixels, 111u);
  ASSERT_EQ(outcome.classes[0].duplicates.size(), 1u);
  EXPECT_TRUE(holds(merge_text(outcome), "shard 00000 was done before: 00000.attempt-2 is not taken"));
  const Json list = Json::parse(read_text(root_ / "merged/merge.json"));
  EXPECT_EQ(list["classes"][0]["duplicates"][0]["folder"], "shards/00000.attempt-2");
}

TEST_F(MergeTest, RefusesWhatIsOfAnotherExperiment) {
  struct Planted {
    std::function<void(Report&)> plant;
    std::string told;
  };
  const std::vector<Planted> all = {
      {[](Report& r) { r.config["seeds"] = 3; }, "another config"},
      {[](Report& r) { r.kernels = std::string(32, '0'); }, "other kernels or methods"},
      {[](Report& r) { r.git.commit = std::string(40, '0'); }, "another programme, commit 0000000"},
      {[](Report& r) { r.git.dirty = true; }, "another programme"},
      {[](Report& r) { r.complete = false; }, "an interrupted run"},
      {[](Report& r) { r.cases.pop_back(); }, "other cases than its shard"},
      {[](Report& r) { r.cases[1].id = "cornell/mfis/N=99"; }, "other cases than its shard"},
      {[](Report& r) { r.scenes[0].hash = "another"; }, "the hash of scene cornell"},
      {[](Report& r) { r.cases[1].accuracy->smape.formula = "smape-of-old"; }, "the formula of smape"},
      {[](Report& r) { r.cases[1].accuracy->reference.hash = "another"; }, "the reference of cornell"}};
  for (size_t k = 0; k < all.size(); ++k) {
    const fs::path root = root_ / std::to_string(k);
    const MadeSweep sweep(root, made_blocks("cornell", 2, 2));
    sweep.finish(0);
    const std::string before = text_of(merge_sweep(root).classes.at(0));
    Report report = sweep.report(1);
    all[k].plant(report);
    sweep.finish(1, report);
    const MergeOutcome outcome = merge_sweep(root);
    EXPECT_EQ(outcome.exit_code(), 5) << all[k].told;
    ASSERT_EQ(outcome.refused.size(), 1u) << all[k].told;
    EXPECT_TRUE(holds(outcome.refused[0], "shards/00001: "));
    EXPECT_TRUE(holds(outcome.refused[0], all[k].told));
    EXPECT_TRUE(outcome.classes.empty());
    EXPECT_EQ(before, read_text(root / "merged" / class_folder(report.device) / "report.json"));
  }
}

TEST_F(MergeTest, ReferencesWithAndWithoutOcclusionDiffer) {
  const MadeSweep sweep(root_, made_blocks("cornell", 2, 2));
  sweep.finish(0);
  Report report = sweep.report(1);
  report.cases[1].parameters["visibility"] = "none";
  report.cases[1].accuracy->reference.hash = "without occlusion";
  sweep.finish(1, report);
  EXPECT_EQ(merge().exit_code(), 0);
}

TEST_F(MergeTest, TheAnchorTellsHowFarNodesAreApart) {
  const MadeSweep sweep(root_, made_blocks("cornell", 3, 2));
  sweep.finish(0);
  sweep.finish(1, sweep.report(1, 1.02));  // within the A/A noise of 4 %
  sweep.finish(2);
  MergeOutcome outcome = merge();
  EXPECT_EQ(ids(outcome.classes.at(0).report), sweep.plan.case_ids());  // the anchor once
  EXPECT_EQ(outcome.classes[0].report.aa.size(), 1u);
  EXPECT_TRUE(outcome.classes[0].duplicates.empty());
  ASSERT_EQ(outcome.classes[0].drift.size(), 1u);
  EXPECT_NEAR(outcome.classes[0].drift[0].ratio.value, 1.02, 1e-9);
  EXPECT_EQ(outcome.classes[0].drift[0].farthest.shard, 1u);
  EXPECT_FALSE(outcome.classes[0].drift[0].beyond_noise());
  EXPECT_EQ(outcome.classes[0].report.scenes[0].warnings.size(), 1u);

  fs::remove_all(sweep.folder.done(2));
  sweep.finish(2, sweep.report(2, 0.25));
  outcome = merge();
  const NodeDrift drift = outcome.classes.at(0).drift.at(0);
  EXPECT_EQ(drift.farthest.where, "n2");
  EXPECT_EQ(drift.first.where, "n0");
  EXPECT_NEAR(drift.ratio.value, 0.25, 1e-9);
  EXPECT_TRUE(drift.beyond_noise());
  EXPECT_TRUE(holds(outcome.classes[0].report.scenes[0].warnings.back(), "beyond the A/A noise of 4.0 %"));
}

TEST_F(MergeTest, PicturesStandBesideTheReport) {
  const MadeSweep sweep(root_, made_blocks("cornell", 2, 1));
  for (size_t i = 0; i < 2; ++i) {
    const fs::path work = sweep.work(i, sweep.report(i));
    write_text(work / "images/cornell/reference.exr", "the same");
    write_text(work / "images/cornell/contact.png", fmt::format("sheet {}", i));
    write_text(work / fmt::format("images/cornell/mfis/N={}.exr", i), fmt::format("image {}", i));
    sweep.folder.finish(i, 1);
  }
  const fs::path images = merge().classes.at(0).folder / "images/cornell";
  merge();
  EXPECT_EQ(read_text(images / "mfis/N=0.exr"), "image 0");
  EXPECT_EQ(read_text(images / "mfis/N=1.exr"), "image 1");
  EXPECT_EQ(read_text(images / "contact.png"), "sheet 0");
  EXPECT_EQ(read_text(images / "shard-00001-contact.png"), "sheet 1");
  EXPECT_EQ(read_text(images / "reference.exr"), "the same");
  size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(images)) files += entry.is_regular_file();
  EXPECT_EQ(files, 5u);  // and no temporary one
}

}  // namespace
}  // namespace vsglbench
