// Tables that fit a terminal, sorted, and in other formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/csv.h"
#include "report/synthetic_report.h"
#include "report/table.h"

namespace vsglbench {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

size_t width_of(const std::string& text) {
  size_t widest = 0;
  for (const auto& line : lines_of(text)) {
    widest = std::max(
        widest, static_cast<size_t>(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; })));
  }
  return widest;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

CaseResult with_error(const std::string& id, double smape) {
  CaseResult c = synthetic_case(id);
  for (SeedResult& s : c.seeds) s.errors.smape += smape - 12;
  c.accuracy = accuracy_over_seeds(c.seeds, c.accuracy->reference);
  return c;
}

Report three() {
  Report r = synthetic_report();
  r.cases = {with_error("cornell/mfis/N=64", 20), with_error("cornell/mfis/N=256", 5),
             with_error("cornell/mfis/N=1024", 10),
             synthetic_failure("cornell/vpl/N=64", Status::failed, "a NaN in pass shade")};
  return r;
}

std::vector<std::string> order(const std::string& table) {
  std::vector<std::string> out;
  for (const auto& line : lines_of(table)) {
    const size_t at = line.find("N=");
    if (line.starts_with("  ") && at != std::string::npos)
      out.push_back(line.substr(at, line.find(' ', at) - at));
  }
  return out;
}

TEST(TableFit, WithoutALimitNothingIsLeftOut) {
  const std::string table = terminal_table(three());
  EXPECT_TRUE(contains(table, "rays ms (host)"));
  EXPECT_FALSE(contains(table, "left out"));
}

TEST(TableFit, ThePartsOfAFrameStandWhereTheyAreNamed) {
  EXPECT_FALSE(contains(terminal_table(three()), "shade ms"));
  TableOptions options;
  options.columns = {"fixed", "shade"};
  const std::string table = terminal_table(three(), options);
  EXPECT_TRUE(contains(table, "fixed ms"));
  EXPECT_TRUE(contains(table, "shade ms"));
}

TEST(TableFit, FitsAndSaysWhatItLeftOut) {
  for (const size_t width : {60, 72, 80, 100, 120}) {
    const std::string table = terminal_table(three(), {.width = width});
    EXPECT_LE(width_of(table), width) << table;
    EXPECT_TRUE(contains(table, "SMAPE %")) << width;
  }
  const std::string narrow =
      terminal_table(three(), {.columns = {"smape", "rmse", "method", "frame"}, .width = 56});
  EXPECT_TRUE(contains(narrow, "left out, as 56 columns have no room for them: ")) << narrow;
  EXPECT_TRUE(contains(narrow, "--wide"));
  EXPECT_FALSE(contains(lines_of(narrow)[0], "frame ms"));
}

// All three cases have the same times: they are no column, but a line.
TEST(TableFit, WhatDoesNotDifferIsSaidOnce) {
  const std::string table = terminal_table(three(), {.width = 300});
  EXPECT_FALSE(contains(lines_of(table)[0], "method ms"));
  EXPECT_TRUE(contains(table, "the same in every row: "));
  EXPECT_TRUE(contains(table, "frame ms 27.00"));
  Report other = three();
  other.cases[1].frame->span = summarize({1, 2, 3, 4});
  EXPECT_TRUE(contains(lines_of(terminal_table(other, {.width = 300}))[0], "frame ms"));
  EXPECT_TRUE(
      contains(lines_of(terminal_table(three(), {.columns = {"method"}, .width = 300}))[0], "method ms"));
}

TEST(TableFit, LongNamesAreShortenedInTheMiddleWhereNothingElseHelps) {
  Report r = three();
  r.cases = {
      with_error(
          "cornell/kmeans3d-segmented/N=64,bias_reduction=0.1,shading=vsgl14,light_clearance=sigma,diffuse=a",
          3),
      with_error(
          "cornell/kmeans3d-segmented/N=64,bias_reduction=0.2,shading=vsgl16,light_clearance=0,diffuse=b",
          4)};
  const std::string table = terminal_table(r, {.width = 60});
  EXPECT_LE(width_of(table), 60u) << table;
  EXPECT_TRUE(contains(table, "…"));
  EXPECT_TRUE(contains(table, "diffuse=a") && contains(table, "diffuse=b")) << table;
  EXPECT_FALSE(contains(terminal_table(r), "…"));
}

TEST(TableFit, SortsWithinAScene) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(order(terminal_table(three())), (Names{"N=64", "N=256", "N=1024", "N=64"}));
  EXPECT_EQ(order(terminal_table(three(), {.sort = "smape"})), (Names{"N=256", "N=1024", "N=64", "N=64"}));
  EXPECT_EQ(order(terminal_table(three(), {.sort = "-smape"})), (Names{"N=64", "N=1024", "N=256", "N=64"}));
  EXPECT_TRUE(contains(lines_of(terminal_table(three(), {.sort = "-smape"}))[5],
                       "failed"));  // without a number: last
  EXPECT_THROW(terminal_table(three(), {.sort = "smap"}), Error);
  EXPECT_THROW(terminal_table(three(), {.across = "N", .sort = "smape"}), Error);
}

TEST(TableFormats, CsvHasEveryNumberAndQuotesCommas) {
  Report r = three();
  r.cases[0].id = "cornell/mfis/N=64,say=\"x\"";
  const auto rows = parse_csv(csv_table(r, {.columns = {"smape", "method"}}));
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"scene", "case", "method", "status", "smape", "smape_lo",
                                               "smape_hi", "method", "method_lo", "method_hi"}));
  EXPECT_EQ(rows[1][1], r.cases[0].id);
  EXPECT_EQ(std::strtod(rows[1][4].c_str(), nullptr), *r.cases[0].accuracy->smape.value);
  EXPECT_EQ(std::strtod(rows[1][6].c_str(), nullptr), r.cases[0].accuracy->smape.ci95->hi);
  EXPECT_EQ(std::strtod(rows[1][7].c_str(), nullptr), r.cases[0].frame->method->median);
  EXPECT_EQ(rows[4][3], "failed");
  EXPECT_EQ(rows[4][4], "");
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
}

TEST(TableFormats, CsvHoldsNothingThatSteersATerminal) {
  Report report = three();
  report.cases[0].id += "\x1b[2J\n";
  for (const char* across : {"", "method"}) {
    const std::string csv = csv_table(report, {.across = across});
    EXPECT_EQ(csv.find('\x1b'), std::string::npos) << csv;
  }
}

TEST(TableFormats, LatexEscapesWhatItWouldTakeForItsOwn) {
  Report r = three();
  r.cases[0].id = "cornell/mfis/N=64,a_b=50%,c=#1&{x}$^~\\";
  r.cases[3].error->message = "100 % of $HOME_DIR";
  const std::string table = latex_table(r);
  EXPECT_TRUE(contains(table, "\\begin{tabular}{lr")) << table;
  EXPECT_TRUE(contains(table, "\\toprule"));
  EXPECT_TRUE(contains(
      table, "a\\_b=50\\%,c=\\#1\\&\\{x\\}\\$\\textasciicircum{}\\textasciitilde{}\\textbackslash{}"))
      << table;
  EXPECT_TRUE(contains(table, "100 \\% of \\$HOME\\_DIR"));
  EXPECT_TRUE(contains(table, "SMAPE \\%"));
  EXPECT_TRUE(contains(table, "$\\pm$") && !contains(table, "±"));
  EXPECT_TRUE(contains(table, "\\bottomrule\n\\end{tabular}"));
  // As many cells in each row as there are columns.
  const std::string spec =
      table.substr(table.find("{l") + 1, table.find("}\n\\toprule") - table.find("{l") - 1);
  for (const auto& line : lines_of(table)) {
    if (!line.starts_with("\\quad mfis")) continue;
    size_t cells = 1;
    for (size_t at = 0; (at = line.find(" & ", at)) != std::string::npos; ++at) ++cells;
    EXPECT_EQ(cells, spec.size()) << line;
  }
}

}  // namespace
}  // namespace vsglbench
