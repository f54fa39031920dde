// plot, analyse, claims and the formats of table, on committed reports.
#include <filesystem>

#include "base/csv.h"
#include "base/file.h"
#include "cli/cli_fixture.h"

namespace vsglbench {
namespace {

const std::string kCut = std::string(VSGLBENCH_SOURCE_DIR) + "/reports/cut-lavapipe";

TEST_F(CliTest, PlotPrintsWhatItWrote) {
  const std::string out = (folder_ / "plots").string();
  const Finished f = run({"plot", kCut, "--scene", "colonnade:cut", "--metric", "rmse", "--out", out});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, out + "/colonnade@cut-none-front-rmse.svg\n")) << f.out;
  EXPECT_TRUE(contains(f.out, "colonnade@cut-none-over-N-rmse.png\n")) << f.out;
  for (size_t at = 0; at < f.out.size(); at = f.out.find('\n', at) + 1)
    EXPECT_TRUE(std::filesystem::exists(f.out.substr(at, f.out.find('\n', at) - at)));
  expect_refused(run({"plot", kCut, "--scene", "cornel"}), 2, "did you mean 'cornell'");
  expect_refused(run({"plot", kCut, "--metric", "smap"}), 2, "did you mean 'smape'");
  expect_refused(run({"plot", std::string(VSGLBENCH_SOURCE_DIR) + "/reports/mfis16-table1-lavapipe"}), 2,
                 "nothing to draw");
}

// What is committed beside a report is what the programme says of it.
TEST_F(CliTest, CommittedAnswersAndClaimsAreThoseOfTheirReports) {
  const std::string reports = std::string(VSGLBENCH_SOURCE_DIR) + "/reports/",
                    front = reports + "front-lavapipe";
  EXPECT_EQ(run({"answer", front}).out, read_text(front + "/answer.txt"));
  EXPECT_EQ(run({"claims", front, "--markdown"}).out, read_text(front + "/claims.md"));
  const std::string own = reports + "own-lavapipe";
  EXPECT_EQ(run({"answer", own, "--method", "cut"}).out, read_text(own + "/verdicts.md"));
}

TEST_F(CliTest, AnalyseWritesIntoTheReport) {
  const std::string copy = (folder_ / "report.json").string();
  std::filesystem::copy_file(kCut + "/report.json", copy);
  const Json printed = Json::parse(run({"analyse", copy, "--sum", "frame"}).out);
  EXPECT_EQ(printed.at("time"), "frame");
  EXPECT_TRUE(read_report(copy).analysis.is_null());
  EXPECT_EQ(run({"analyse", copy, "--write"}).code, 0);
  EXPECT_EQ(read_report(copy).analysis.at("time"), "method");
  EXPECT_FALSE(read_report(copy).analysis.at("groups").empty());
}

TEST_F(CliTest, ClaimsSayWhatHoldsAndWhatWasNotRun) {
  const Finished f = run({"claims", kCut});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "world-space-beside-columns: ")) << f.out;
  EXPECT_TRUE(contains(f.out, "not run")) << f.out;
  EXPECT_TRUE(contains(run({"claims", kCut, "--markdown", "--claim", "world-space-beside-columns"}).out,
                       "| colonnade | rmse |"));
  expect_refused(run({"claims", kCut, "--claim", "nothing"}), 2, "no claim is named 'nothing'");
}

TEST_F(CliTest, TableFitsColumnsAndKnowsFormats) {
  ::setenv("COLUMNS", "70", 1);
  const std::string narrow = run({"table", kCut}).out, wide = run({"table", kCut, "--wide"}).out;
  ::unsetenv("COLUMNS");
  EXPECT_TRUE(contains(narrow, "--wide shows them")) << narrow;
  EXPECT_EQ(wide, run({"table", kCut}).out);  // a pipe has no width
  EXPECT_EQ(run({"table", kCut, "--format", "markdown"}).out, run({"table", kCut, "--markdown"}).out);
  EXPECT_GT(parse_csv(run({"table", kCut, "--format", "csv", "--sort", "-method"}).out).size(), 20u);
  EXPECT_TRUE(contains(run({"table", kCut, "--format", "latex"}).out, "\\bottomrule"));
  expect_refused(run({"table", kCut, "--sort", "smap"}), 2, "no column 'smap'");
}

}  // namespace
}  // namespace vsglbench
