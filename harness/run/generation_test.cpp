// Runs in which only the generation of the lights is measured.
#include <algorithm>

#include "report/table.h"
#include "run/run_fixture.h"
#include "run/runner.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class GenerationTest : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    config_["measure"] = "generation";
    config_.erase("seeds");
    config_.erase("reference");
    config_["timing"] = {{"min_samples", 3}, {"max_samples", 3}};
  }
  RunOutcome run() {
    RunOptions options;
    options.config = write_config();
    options.out = out_;
    options.argv = {"vsglbench", "run"};
    return run_config(options);
  }
};

TEST_F(GenerationTest, TimesTheGeneratePassesAndNothingElse) {
  config_["methods"] = {
      {{"method", "mfis"}}, {{"method", "vpl"}}, {{"method", "fis"}}, {{"method", "all-texels"}}};
  EXPECT_EQ(run().exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = read_report(out_ / "report.json");
  EXPECT_EQ(r.config.at("measure"), "generation");
  EXPECT_EQ(r.config.at("pdfs_made_by"), "mfis");
  EXPECT_FALSE(r.config.contains("visibility") || r.config.contains("seeds"));
  ASSERT_EQ(r.cases.size(), 4u);
  EXPECT_EQ(r.cases[0].id, "cornell/mfis/N=16,rsm=16");
  for (const CaseResult& c : r.cases) {
    ASSERT_EQ(c.status, Status::ok) << c.id << c.error->message;
    EXPECT_EQ(c.measure, Measure::generation);
    EXPECT_FALSE(c.accuracy.has_value());
    EXPECT_TRUE(c.seeds.empty() && c.images.empty());
    EXPECT_FALSE(c.parameters.contains("visibility"));
    EXPECT_EQ(c.frame->span.samples.size(), 3u);
    EXPECT_EQ(c.stopping->frames, 3u);
    EXPECT_GE(c.stopping->warmup_frames, 1u);
    EXPECT_EQ(c.health->nan + c.health->inf, 0u);
    EXPECT_EQ(c.generate->lights, c.method == "all-texels" ? 256u : 16u);
    EXPECT_LT(c.generate->empty, c.generate->lights) << "the PDF leads to no lit texel";
    bool gbuffer = false;
    for (const auto& pass : c.passes) {
      EXPECT_EQ(pass.pass.stage, PassStage::generate) << pass.pass.name();
      EXPECT_EQ(pass.ms.samples.size(), 3u);
      gbuffer |= pass.pass.half == Half::gbuffer;
    }
    EXPECT_EQ(gbuffer, c.method != "all-texels") << c.id;
    EXPECT_EQ(c.generate->gbuffer_ms > 0, gbuffer) << c.id;
    EXPECT_GT(c.generate->rsm_ms, 0);
  }
  ASSERT_EQ(r.aa.size(), 1u);
  EXPECT_EQ(r.aa[0].times.at(0).column, "generate");
  EXPECT_FALSE(fs::exists(out_ / "images"));
  EXPECT_EQ(r.wall.references_s, 0);
  EXPECT_EQ(r.wall.visibility_s, 0);
  EXPECT_NE(terminal_table(r).find("x first"), std::string::npos);
}

// Each size has halves and PDFs of its own, which the cases of other sizes, interleaved, leave alone: the
// lights of a sweep are those of each case by itself.
TEST_F(GenerationTest, SizesDoNotDisturbEachOther) {
  config_["methods"] = {{{"method", "mfis"}}};
  config_["rsm"] = {16, 32};
  config_["importance_lights"] = {4, 16};
  EXPECT_EQ(run().exit_code, 0);
  const Report all = read_report(out_ / "report.json");
  ASSERT_EQ(all.cases.size(), 4u);
  for (const CaseResult& c : all.cases) {
    config_["rsm"] = c.parameters.at("rsm");
    config_["importance_lights"] = c.parameters.at("importance_lights");
    run();
    const Report one = read_report(out_ / "report.json");
    EXPECT_EQ(one.cases.at(0).generate->empty, c.generate->empty) << c.id;
    EXPECT_EQ(one.cases.at(0).generate->dispatches, c.generate->dispatches) << c.id;
  }
}

TEST_F(GenerationTest, ImpossibleCasesFailAlone) {
  config_["N"] = {0, 16, 257};
  EXPECT_EQ(run().exit_code, 1);
  expect_sound(out_ / "report.json");
  const Report r = read_report(out_ / "report.json");
  EXPECT_EQ(r.cases.at(0).status, Status::failed);
  EXPECT_EQ(r.cases.at(1).status, Status::ok);
  EXPECT_TRUE(contains(r.cases.at(2).error->message, "use 1 … 256"));
}

}  // namespace
}  // namespace vsglbench
