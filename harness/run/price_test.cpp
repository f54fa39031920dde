// What the effects of a scene cost, in a run's report: of which case, once, and at nobody's cost.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "run/journal.h"
#include "run/run_fixture.h"
#include "run/runner.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class PriceTest : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    config_["price_effects"] = 2;
  }
  RunOptions options() const {
    RunOptions o;
    o.config = write_config();
    o.out = out_;
    o.argv = {"vsglbench", "run"};
    return o;
  }
  // Its actions are kept in a file beside the folder.
  RunOptions watched_options(const std::string& diary) const {
    RunOptions o = options();
    o.sabotage = [file = folder_ / diary](const Activity& a) {
      std::ofstream(file, std::ios::app) << a.action + "\n";
    };
    return o;
  }
  size_t actions(const std::string& diary, const std::string& part) const {
    std::ifstream in(folder_ / diary);
    size_t count = 0;
    for (std::string line; std::getline(in, line);) count += line.starts_with(part) ? 1 : 0;
    return count;
  }
  Report report() const { return read_report(out_ / "report.json"); }

  static void expect_priced(const SceneReport& scene) {
    ASSERT_EQ(scene.effects.size(), kEffects);
    for (const EffectReport& e : scene.effects) {
      const bool priced = !e.name.starts_with("moving_");
      EXPECT_EQ(e.ms && e.ms_ci95 && e.bytes, priced) << e.name;
      if (!priced) continue;
      EXPECT_LE(e.ms_ci95->lo, *e.ms) << e.name;
      EXPECT_GE(e.ms_ci95->hi, *e.ms) << e.name;
      EXPECT_GE(*e.bytes, 0) << e.name;
    }
    ASSERT_TRUE(scene.effects_priced);
    EXPECT_GT(scene.effects_priced->seconds, 0);
  }
};

bool is_pricing(const Activity& a) { return a.action.starts_with("pricing effects: "); }

TEST_F(PriceTest, IsOfTheFirstSoundCase) {
  config_["methods"] = {{{"method", "vpl"}, {"N", {0, 16}}}, {{"method", "mfis"}}};
  EXPECT_EQ(run_config(options()).exit_code, 1);  // N = 0
  expect_sound(out_ / "report.json");
  const SceneReport scene = report().scenes.at(0);
  expect_priced(scene);
  const EffectPricing& priced = *scene.effects_priced;
  EXPECT_EQ(priced.case_id, "cornell/vpl/N=16,rsm=16,vis=exact");
  EXPECT_EQ(priced.rounds, 2u);
  EXPECT_GT(priced.span_ms, 0);
  EXPECT_GT(priced.bytes_all, priced.bytes);  // a Lambert room
  EXPECT_EQ(scene.warnings, std::vector<std::string>());
  // Occlusion is what its bits of visibility take: 576 pixels by 16 lights.
  for (const EffectReport& e : scene.effects) {
    if (e.name == "occlusion") {
      EXPECT_EQ(*e.bytes, 576 / 8 * 16);
    }
  }
}

TEST_F(PriceTest, IsNotAskedForUnlessSomebodyAsks) {
  config_.erase("price_effects");
  EXPECT_EQ(run_config(options()).exit_code, 0);
  const SceneReport scene = report().scenes.at(0);
  EXPECT_EQ(scene.effects.size(), kEffects);
  EXPECT_FALSE(scene.effects_priced);
  EXPECT_FALSE(scene.effects.at(0).ms);
  RunOptions o = options();
  o.price_effects = 1;
  EXPECT_EQ(run_config(o).exit_code, 0);
  expect_priced(report().scenes.at(0));
  EXPECT_EQ(report().config.at("price_effects"), 1);
}

TEST_F(PriceTest, ComesAfterEverythingThatIsTimed) {
  EXPECT_EQ(run_config(watched_options("diary")).exit_code, 0);
  std::ifstream in(folder_ / "diary");
  bool begun = false;
  for (std::string line; std::getline(in, line);) {
    begun |= line.starts_with("pricing");
    if (begun) {
      EXPECT_TRUE(line.starts_with("pricing")) << line;
    }
  }
  EXPECT_TRUE(begun);
}

// Its effects are those that the case is rendered with.
TEST_F(PriceTest, OfACaseThatForcesAllIsAgainstItself) {
  config_["force_effects"] = "all";
  EXPECT_EQ(run_config(options()).exit_code, 0);
  const SceneReport scene = report().scenes.at(0);
  expect_priced(scene);
  EXPECT_EQ(scene.effects_priced->bytes, scene.effects_priced->bytes_all);
}

// A crash while pricing costs the prices.
TEST_F(PriceTest, ACrashCostsThePricesAlone) {
  RunOptions o = options();
  o.sabotage = [](const Activity& a) {
    if (is_pricing(a)) std::raise(SIGKILL);
  };
  EXPECT_EQ(run_config(o).exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_TRUE(r.complete);
  EXPECT_EQ(r.cases.at(0).status, Status::ok);
  EXPECT_EQ(r.aa.size(), 1u);
  EXPECT_FALSE(r.scenes.at(0).contact.empty());
  EXPECT_FALSE(r.scenes.at(0).effects_priced);
  EXPECT_FALSE(r.scenes.at(0).effects.at(0).ms);
  ASSERT_EQ(r.scenes.at(0).warnings.size(), 1u);
  EXPECT_TRUE(contains(r.scenes.at(0).warnings[0], "during pricing effects: "));
}

// Killed while the first effects are priced, the run goes on with the prices, and with nothing else.
TEST_F(PriceTest, AnInterruptedRunIsPricedInTheEnd) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    RunOptions o = options();
    o.sabotage = [parent = ::getpid()](const Activity& a) {
      if (is_pricing(a)) ::kill(parent, SIGKILL);
    };
    ::_exit(run_config(o).exit_code);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_FALSE(fs::exists(out_ / "report.json"));

  EXPECT_EQ(run_config(watched_options("diary")).exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_TRUE(r.complete);
  ASSERT_EQ(r.cases.size(), 1u);
  expect_priced(r.scenes.at(0));
  EXPECT_EQ(actions("diary", "frame "), 0u);
  EXPECT_EQ(actions("diary", "seed "), 0u);
  EXPECT_GT(actions("diary", "pricing"), 0u);
}

// What is priced stays priced: the second scene's prices alone are made.
TEST_F(PriceTest, WhatIsPricedIsNotPricedAgain) {
  config_["scenes"] = {"cornell", "ring514"};
  EXPECT_EQ(run_config(watched_options("first")).exit_code, 0);
  Report stopped = report();
  const Json before = part_to_json(stopped.scenes.at(0));
  stopped.complete = false;
  stopped.cases.pop_back();
  stopped.scenes.pop_back();
  stopped.aa.pop_back();
  write_report(out_ / "report.json", stopped);
  EXPECT_EQ(run_config(watched_options("second")).exit_code, 0);
  const Report resumed = report();
  ASSERT_EQ(resumed.scenes.size(), 2u);
  EXPECT_EQ(part_to_json(resumed.scenes[0]), before);
  expect_priced(resumed.scenes[1]);
  EXPECT_EQ(resumed.scenes[1].effects_priced->case_id, resumed.cases.at(1).id);
  EXPECT_EQ(2 * actions("second", "pricing"), actions("first", "pricing"));
}

}  // namespace
}  // namespace vsglbench
