#include "sweep/plan.h"

#include <algorithm>
#include <set>

#include "report/case_names.h"
#include "run/config_fixture.h"
#include "sweep/shard_folder.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class PlanTest : public ConfigTest {
 protected:
  SweepPlan plan(const std::string& shards_by = "scene") const {
    RunOptions run;
    run.config = write_config();
    return make_plan(run, shards_by);
  }
  void use_two_scenes() {
    config_["scenes"] = {"cornell", "ring514"};
    config_["methods"] = {{{"method", "vpl"}, {"N", {2, 4, 8, 16, 32}}}};
  }
  template <class Action>
  static std::string error_of(const Action& action) {
    try {
      action();
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      return e.what();
    }
    return "no error";
  }
};

TEST_F(PlanTest, ASceneIsAShard) {
  use_two_scenes();
  const SweepPlan p = plan();
  ASSERT_EQ(p.shards.size(), 2u);
  EXPECT_EQ(p.shards[1].scene, "ring514");
  EXPECT_EQ(p.shards[0].cases.size(), 5u);
  EXPECT_EQ(p.shards[0].anchor, "");
  EXPECT_EQ(p.case_ids(), ids());
  EXPECT_EQ(p.scenes(), (std::vector<std::string>{"cornell", "ring514"}));
}

TEST_F(PlanTest, BlocksOfASceneBeginWithItsAnchor) {
  use_two_scenes();
  const SweepPlan p = plan("block:2");
  ASSERT_EQ(p.shards.size(), 6u);  // 5 cases of each scene in blocks of at most 2
  for (const Shard& s : p.shards) {
    EXPECT_EQ(s.anchor, s.scene + "/vpl/N=2,rsm=16,vis=exact");
    EXPECT_EQ(s.cases.front(), s.anchor);
    EXPECT_LE(s.cases.size(), 3u);
    EXPECT_EQ(std::set(s.cases.begin(), s.cases.end()).size(), s.cases.size());
  }
  EXPECT_EQ(p.case_ids(), ids());
  EXPECT_EQ(plan("block:5").shards.size(), 2u);  // no scene has more
  EXPECT_EQ(plan("block:5").shards[0].anchor, "");
}

TEST_F(PlanTest, RefusesOtherWaysToDivide) {
  for (const char* by : {"", "case", "block", "block:", "block:0", "block:-1", "block:2x", "blocks:2"})
    EXPECT_TRUE(contains(error_of([&] { plan(by); }), "--shards-by takes scene or block:N")) << by;
}

TEST_F(PlanTest, IsReadAsItWasWritten) {
  use_two_scenes();
  const SweepPlan p = plan("block:2");
  write_plan(out_, p);
  const SweepPlan read = read_plan(out_);
  EXPECT_EQ(to_json(read), to_json(p));
  write_plan(out_, plan("block:2"));  // the same once more
  EXPECT_TRUE(contains(error_of([&] { write_plan(out_, plan()); }), "another sweep is planned there"));
  EXPECT_TRUE(contains(error_of([&] { read_plan(folder_ / "absent"); }), "no sweep is planned there"));
}

TEST_F(PlanTest, AnEditedPlanIsRefused) {
  write_plan(out_, plan());
  Json json = Json::parse(read_text(out_ / kPlanFile));
  json["shards"][0]["cases"][0] = "cornell/vpl/N=3";
  write_text(out_ / kPlanFile, json.dump(1));
  EXPECT_TRUE(contains(error_of([&] { read_plan(out_); }), "the file was edited"));
  json.erase("kernels");
  write_text(out_ / kPlanFile, json.dump(1));
  EXPECT_TRUE(contains(error_of([&] { read_plan(out_); }), "plan.json:1: "));
}

TEST_F(PlanTest, WhatHasChangedSinceIsNamed) {
  const SweepPlan p = plan();
  check_unchanged(p);
  SweepPlan other = p;
  other.kernel_sources = std::string(32, '0');
  EXPECT_TRUE(contains(error_of([&] { check_unchanged(other); }), "the kernels have changed"));
  other = p;
  other.plugins["vpl"] = std::string(32, '0');
  EXPECT_TRUE(contains(error_of([&] { check_unchanged(other); }), "the method vpl has changed"));
  other = p;
  other.git.commit = std::string(40, '0');
  EXPECT_TRUE(contains(error_of([&] { check_unchanged(other); }), "the programme has changed"));
  config_["seeds"] = 3;
  write_config();
  EXPECT_TRUE(contains(error_of([&] { check_unchanged(p); }), "config.json has changed"));
}

TEST(ExactGlobs, TakeTheirIdAlone) {
  const std::vector<std::string> ids = {"s/m/a=[1,2]", "s/m/a=*", "s/m/a=?", "s/m/a=\\x", "s/m/a=1"};
  const std::vector<std::string> globs = exact_globs(ids);
  for (size_t i = 0; i < ids.size(); ++i)
    for (size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(matches_glob(ids[k], globs[i]), i == k) << globs[i];
}

}  // namespace
}  // namespace vsglbench
