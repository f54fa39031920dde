// Options of `vsglbench run`, and what it says.
#include "cli/cli_fixture.h"

namespace vsglbench {
namespace {

class RunCommand : public CliTest {
 protected:
  Finished measure(std::vector<std::string> more, bool quiet = true) const {
    std::vector<std::string> all = {"run", write_config().string(), "--out", out_.string()};
    if (quiet) all.insert(all.begin(), "-q");
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(RunCommand, SetReplacesWhatTheConfigSays) {
  config_["methods"] = {{{"method", "vpl"}, {"N", {8, 16}}}, {{"method", "mfis"}}};
  const Finished f = measure({"--set", "N=4", "--set", "visibility=none"});
  ASSERT_EQ(f.code, 0) << f.err;
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 2u);
  EXPECT_EQ(r.cases[0].id, "cornell/vpl/N=4,rsm=16,vis=none");
  EXPECT_EQ(r.cases[1].generate->lights, 4u);
  EXPECT_EQ(r.config.at("set"), (Json{{"N", 4}, {"visibility", "none"}}));
  EXPECT_EQ(r.config.at("N"), 4);
}

TEST_F(RunCommand, SetRefusesWhatItDoesNotKnow) {
  expect_refused(measure({"--set", "visibilty=none"}), 2, "did you mean 'visibility'?");
  expect_refused(measure({"--set", "N=many"}), 2, "must be an integer within 0");
  expect_refused(measure({"--set", "N"}), 2, "KEY=VALUE");
}

TEST_F(RunCommand, NoiseIsAPercentageLikeAFloor) {
  for (const char* noise : {"1000000%", "1000000 %"}) {
    const Finished f = measure({"--require-noise", noise});
    EXPECT_EQ(f.code, 0) << noise << f.err;
  }
  for (const char* noise : {"5", "0%", "%", "-5%", "5  %", "5%%"})
    expect_refused(measure({"--require-noise", noise}), 2, "--require-noise takes a percentage above 0");
  const Finished f = run({"reference", "cornell", "--width", "32", "--height", "18", "--samples", "4",
                          "--batches", "2", "--floor", "150 %", "--out", out_.string()});
  EXPECT_EQ(f.code, 0) << f.err;
}

TEST_F(RunCommand, SaysThatSamplesWereRoundedUp) {
  config_["reference"] = {{"samples", 5}, {"batches", 4}};
  const std::string note = "of 8 samples (5 asked for, rounded up to 4 equal batches)";
  EXPECT_TRUE(contains(measure({}, false).err, note));
  config_["reference"] = {{"samples", 8}, {"batches", 4}};
  const Finished f = measure({}, false);
  EXPECT_TRUE(contains(f.err, "of 8 samples "));
  EXPECT_EQ(f.err.find("asked for"), std::string::npos) << f.err;
}

TEST_F(RunCommand, PricesTheLedgerAndPrintsIt) {
  const Finished plain = measure({});
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_TRUE(contains(
      plain.out, "cornell calls for 3 of 14 effects: diffuse_receivers, diffuse_emitters, occlusion\n"));
  EXPECT_EQ(plain.out.find("with all effects"), std::string::npos) << plain.out;
  const Finished priced = measure({"--price-effects=2"});
  ASSERT_EQ(priced.code, 0) << priced.err;
  EXPECT_TRUE(contains(priced.out, "; with all effects "));
  EXPECT_TRUE(contains(priced.out, " times as long; 2 rounds, "));
  EXPECT_TRUE(contains(priced.out, "\n  glossy_receivers             skipped  "));

  // The report's ledger is what `effects` shows of it.
  for (const std::string& path : {out_.string(), (out_ / "report.json").string()}) {
    const Finished shown = run({"effects", path});
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_TRUE(shown.out.starts_with("cornell\ndiffuse_receivers")) << shown.out;
    EXPECT_TRUE(contains(shown.out, " times as long; 2 rounds, "));
  }
  const Json rows = Json::parse(run({"effects", out_.string(), "--json"}).out).at("cornell");
  ASSERT_EQ(rows.size(), 14u);
  EXPECT_EQ(rows[0].at("ms"), *report().scenes.at(0).effects.at(0).ms);
  expect_refused(run({"effects", out_.string(), "--price"}), 2, "run --price-effects");
  expect_refused(measure({"--price-effects=0"}), 2, "--price-effects");
  expect_refused(measure({"--price-effects=-1"}), 2, "--price-effects");
  expect_refused(measure({"--price-effects=many"}), 2, "--price-effects");

  config_["measure"] = "generation";
  config_.erase("seeds");
  config_.erase("reference");
  expect_refused(measure({"--price-effects"}), 2, "measures generation alone");
}

TEST_F(RunCommand, OnlyTakesAGlobThatMatches) {
  config_["methods"] = {{{"method", "vpl"}}, {{"method", "mfis"}}};
  ASSERT_EQ(measure({"--only", "*/mfis/*"}).code, 0);
  ASSERT_EQ(report().cases.size(), 1u);
  EXPECT_EQ(report().cases[0].method, "mfis");
  expect_refused(measure({"--only", "cornell/mfsi/N=16,rsm=16,vis=exact"}), 2,
                 "matches none of the 2 cases; the nearest is 'cornell/mfis/N=16,rsm=16,vis=exact'");
}

TEST_F(CliTest, ListKeysSaysWhatACaseHas) {
  const Finished f = run({"list", "keys"});
  EXPECT_EQ(f.code, 0) << f.err;
  for (const char* part : {"light_clearance  ", "default exact; none, exact, ism, aism, tism; read by: "})
    EXPECT_TRUE(contains(f.out, part));
  EXPECT_EQ(Json::parse(run({"list", "keys", "--json"}).out).at(0).at("default"), 256);
}

}  // namespace
}  // namespace vsglbench
