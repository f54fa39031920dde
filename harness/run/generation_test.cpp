// Runs in which only the generation of the lights is measured.
#include <algorithm>
#include <map>
#include <set>

#include "image/exr.h"
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

// By the key `pdf`, cases of one scene are timed in the same run on PDFs of several makers, and each has the
// lights that it has alone.
TEST_F(GenerationTest, PdfsDoNotDisturbEachOther) {
  Image corner(8, 8);
  for (uint32_t i = 0; i < 16; ++i) corner.at(i % 4, i / 4) = glm::vec3(1);
  const std::string image = (folder_ / "corner.exr").string();
  write_exr(image, corner);
  config_["methods"] = {{{"method", "mfis"}}, {{"method", "kmeans2d"}}};
  config_["pdf"] = {"mfis", "vpl", "own", "flux", image};
  EXPECT_EQ(run().exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report all = read_report(out_ / "report.json");
  ASSERT_EQ(all.cases.size(), 10u);
  EXPECT_TRUE(contains(terminal_table(all), "on the same PDFs where `pdf` is the same: mfis; vpl; "));
  std::map<std::string, double> overlaps;  // of mfis, by its PDF
  for (const CaseResult& c : all.cases) {
    ASSERT_EQ(c.status, Status::ok) << c.id << c.error->message;
    const std::string pdf = c.parameters.at("pdf");
    if (c.method != "mfis") continue;
    overlaps[pdf] = *c.generate->overlap;
    config_["pdf"] = pdf;
    config_["methods"] = {{{"method", c.method}}};
    run();
    const Report one = read_report(out_ / "report.json");
    EXPECT_EQ(one.cases.at(0).generate->overlap, c.generate->overlap) << c.id;
    EXPECT_EQ(one.cases.at(0).generate->gap, c.generate->gap) << c.id;
    EXPECT_EQ(one.cases.at(0).generate->empty, c.generate->empty) << c.id;
  }
  EXPECT_EQ(overlaps.at("own"), overlaps.at("mfis")) << "its own is the one that mfis makes";
  std::set<double> different;
  for (const auto& [pdf, overlap] : overlaps) different.insert(overlap);
  EXPECT_EQ(different.size(), 4u) << "a PDF is not what it should be: two of them draw the same lights";
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
