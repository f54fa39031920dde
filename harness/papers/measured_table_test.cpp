// Rows of a published table from the passes of a report.
#include "papers/measured_table.h"

#include <gtest/gtest.h>

#include "base/error.h"

using namespace vsglbench;

namespace {

CaseResult timed_case(const std::string& scene, const std::string& method,
                      const std::vector<std::pair<std::string, std::vector<double>>>& passes) {
  CaseResult c;
  c.id = scene + "/" + method + "/N=1";
  c.scene = scene;
  c.method = method;
  for (const auto& [name, ms] : passes) c.passes.push_back({parse_pass_name(name), summarize(ms)});
  return c;
}

Exhibit exhibit_of(std::vector<PublishedColumn> table) {
  Exhibit e;
  e.name = "made";
  e.table = std::move(table);
  return e;
}

const PublishedColumn kColumn = {"FIS",
                                 "some GPU",
                                 "*/fis/*",
                                 "*",
                                 {{"Sample", "0.5", {"generate.*.sample"}, false},
                                  {"Mip", "1.5", {"generate.rsm.mipmap"}, false},
                                  {"Total", "2.0", {"generate.*"}, true}}};

TEST(MeasuredTable, AddsUpTheNamedPassesFrameByFrame) {
  Report report;
  report.cases.push_back(timed_case("box", "fis",
                                    {{"generate.gbuffer.sample", {1, 2, 9}},
                                     {"generate.rsm.sample", {10, 30, 20}},
                                     {"generate.rsm.mipmap", {100, 100, 400}},
                                     {"shade", {5000, 5000, 5000}}}));
  const auto tables = tables_of(report, exhibit_of({kColumn}));
  ASSERT_EQ(tables.size(), 1u);
  ASSERT_EQ(tables[0].rows.size(), 3u);
  EXPECT_EQ(tables[0].rows[0].value, 29);  // median of 11, 32, 29
  EXPECT_EQ(tables[0].rows[0].mean, 24);
  EXPECT_EQ(tables[0].rows[1].value, 100);
  EXPECT_EQ(tables[0].rows[2].value, 132);  // median of 111, 132, 429: not the sum of medians
  EXPECT_EQ(tables[0].rows[2].passes.size(), 3u);
}

// What a sum says is what its passes say: of every row that adds passes up, by means, which add up exactly.
TEST(MeasuredTable, SumsAgreeWithTheirPasses) {
  Report report;
  report.cases.push_back(timed_case("box", "fis",
                                    {{"generate.gbuffer.sample", {1.25, 2, 9}},
                                     {"generate.rsm.sample", {10, 30, 20}},
                                     {"generate.rsm.mipmap", {100, 100, 400}}}));
  const auto rows = tables_of(report, exhibit_of({kColumn}))[0].rows;
  double parts = 0;
  for (const MeasuredRow& row : rows) {
    double passes = 0;
    for (const MeasuredPass& pass : row.passes) passes += pass.mean_ms;
    EXPECT_DOUBLE_EQ(row.mean, passes) << row.name;
    if (!row.sum) parts += row.mean;
  }
  EXPECT_DOUBLE_EQ(rows.back().mean, parts);
}

TEST(MeasuredTable, ASceneWithoutEveryColumnHasNone) {
  Report report;
  report.cases.push_back(timed_case("box", "fis", {{"generate.rsm.sample", {1}}}));
  PublishedColumn other = kColumn;
  other.cases = "*/mfis/*";
  EXPECT_TRUE(tables_of(report, exhibit_of({kColumn, other})).empty());
  other.scene = "elsewhere";  // then it is not of this scene
  EXPECT_EQ(tables_of(report, exhibit_of({kColumn, other})).size(), 1u);
}

TEST(MeasuredTable, AColumnOfTwoCasesIsRefused) {
  Report report;
  report.cases.push_back(timed_case("box", "fis", {{"generate.rsm.sample", {1}}}));
  report.cases.push_back(timed_case("box", "fis", {{"generate.rsm.sample", {1}}}));
  EXPECT_THROW(tables_of(report, exhibit_of({kColumn})), Error);
}

TEST(MeasuredTable, ARowWithoutItsPassesHasNoValue) {
  Report report;
  report.cases.push_back(timed_case("box", "fis", {{"generate.rsm.sample", {1}}}));
  const auto rows = tables_of(report, exhibit_of({kColumn}))[0].rows;
  EXPECT_FALSE(rows[1].value);
  EXPECT_TRUE(rows[1].passes.empty());
}

TEST(MeasuredTable, CodeSizeAddsUpCounts) {
  const Json sizes = {{{"method", "fis"}, {"kernels", 3}, {"own_lines", 10}, {"shared_lines", 200}}};
  const PublishedColumn column = {
      "FIS",
      "HLSL",
      "fis",
      "*",
      {{"Shaders", "2", {"/kernels"}, false}, {"Lines", "222", {"/own_lines", "/shared_lines"}, false}}};
  const MeasuredTable table = code_size_table_of(sizes, exhibit_of({column}));
  EXPECT_EQ(table.rows[0].value, 3);
  EXPECT_EQ(table.rows[1].value, 210);
}

TEST(MeasuredTable, PublishedTextIsANumberOrAnError) {
  EXPECT_EQ(published_value("0.816"), 0.816);
  EXPECT_THROW(published_value("0,816"), Error);
  EXPECT_THROW(published_value(""), Error);
}

}  // namespace
