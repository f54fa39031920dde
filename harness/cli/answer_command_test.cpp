// answer, compare and export on a committed report.
#include <filesystem>

#include "base/file.h"
#include "cli/cli_fixture.h"

namespace vsglbench {
namespace {

const std::string kQuick = std::string(VSGLBENCH_SOURCE_DIR) + "/reports/quick-lavapipe";

TEST_F(CliTest, AnswerNamesAMethodAndWhatHalvingCosts) {
  const Finished f = run({"answer", kQuick, "--scene", "cornell", "--error", "smape<=20"});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "for SMAPE at most 20 %, take ")) << f.out;
  EXPECT_TRUE(contains(f.out, "alv")) << f.out;  // "Halving that error", or "Half that error"
  EXPECT_TRUE(contains(f.out, "ms [95 %]")) << f.out;
  EXPECT_TRUE(contains(run({"answer", kQuick, "--time", "1000ms"}).out, "take "));
  EXPECT_TRUE(contains(run({"answer", kQuick}).out, "cornell, with occlusion, llvmpipe")) << f.out;
}

TEST_F(CliTest, AnswerRefusesOnOneLine) {
  expect_refused(run({"answer", kQuick, "--error", "smape<=5", "--time", "2ms"}), 2,
                 "ask for one of --error");
  expect_refused(run({"answer", kQuick, "--error", "smap<=5"}), 2, "did you mean 'smape'");
  expect_refused(run({"answer", kQuick, "--error", "smape"}), 2, "give one like smape<=5");
  expect_refused(run({"answer", kQuick, "--time", "2ms", "--scene", "cornel"}), 2, "did you mean 'cornell'");
  expect_refused(run({"answer", (folder_ / "nothing").string(), "--time", "2ms"}), 2, "nothing");
}

TEST_F(CliTest, CompareOfAReportWithItselfIsQuiet) {
  const Finished f = run({"compare", kQuick, kQuick});
  EXPECT_EQ(f.code, 0) << f.out << f.err;
  EXPECT_TRUE(contains(f.out, "21 cases")) << f.out;
}

TEST_F(CliTest, CompareNamesAWorseError) {
  Json report = Json::parse(read_text(kQuick + "/report.json"));
  for (Json& seed : report["cases"][0]["seeds"]) seed["smape"] = 1.1 * seed["smape"].get<double>();
  const std::string changed = (folder_ / "changed.json").string();
  write_text(changed, report.dump());
  const Finished f = run({"compare", kQuick, changed});
  EXPECT_EQ(f.code, 4) << f.out << f.err;
  EXPECT_TRUE(contains(f.out, "worse")) << f.out;
  report["environment"]["device"]["name"] = "another";
  write_text(changed, report.dump());
  EXPECT_EQ(run({"compare", kQuick, changed}).code, 5);
}

TEST_F(CliTest, ExportWritesEveryFormat) {
  for (const char* format : {"bencher", "github-action", "google-benchmark"}) {
    const Finished f = run({"export", kQuick, "--format", format});
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_FALSE(Json::parse(f.out).empty()) << format;
  }
  expect_refused(run({"export", kQuick, "--format", "benchr"}), 2, "did you mean 'bencher'");
}

// More than a buffer and less than one, and help.
TEST_F(CliTest, WhatReadsReportsSaysWhenItsOutputGoesNowhere) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", kQuick, "--format", "bencher"},
        {"analyse", kQuick},
        {"table", kQuick, "--format", "csv"},
        {"claims", kQuick},
        {"answer", kQuick},
        {"compare", kQuick, kQuick},
        {"--help"},
        {"--version"}})
    expect_refused(finish(start(command, {.standard_output = "/dev/full"})), 2,
                   "standard output: No space left on device");
}

}  // namespace
}  // namespace vsglbench
