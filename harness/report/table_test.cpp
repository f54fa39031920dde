#include "report/table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "report/synthetic_report.h"

using namespace vsglbench;

namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

size_t signs(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

TEST(Table, OneRowACaseAndAligned) {
  Report r = synthetic_report();
  r.cases.push_back(synthetic_case("a much longer name of a case"));
  const auto lines = split(terminal_table(r));
  ASSERT_GE(lines.size(), 5u);
  EXPECT_NE(lines[0].find("generate ms"), std::string::npos);
  EXPECT_NE(lines[1].find("12.00 ± "), std::string::npos);
  EXPECT_NE(lines[1].find("-1.00 ± "), std::string::npos);  // bias in percent
  EXPECT_NE(lines[1].find(" 4.50 "), std::string::npos);    // generate: 0.5 + 1 + 3
  EXPECT_TRUE(lines[1].ends_with(" 27.00"));
  EXPECT_EQ(signs(lines[0]), signs(lines[1]));
  EXPECT_EQ(signs(lines[0]), signs(lines[4]));
}

TEST(Table, FailedAndSkippedCasesSayWhy) {
  const auto lines = split(terminal_table(synthetic_report()));
  EXPECT_NE(lines[2].find("failed: a NaN in pass shade"), std::string::npos);
  EXPECT_NE(lines[3].find("skipped: sponza.gltf is absent"), std::string::npos);
}

TEST(Table, ErrorsUnderTheFloorAreNotDifferences) {
  Report r = synthetic_report();
  r.cases[0].accuracy->reference.noise_floor_smape = 12.5;
  r.cases[0].accuracy->bias.value.reset();
  const std::string table = terminal_table(r);
  EXPECT_NE(table.find("12.00 ≤ floor 12.50"), std::string::npos);
  EXPECT_EQ(table.find("12.00 ±"), std::string::npos);
  EXPECT_NE(table.find("undefined"), std::string::npos);
}

TEST(Table, GenerationAloneIsComparedWithTheScenesFirst) {
  Report r = synthetic_report();
  r.cases = {synthetic_failure("a/broken", Status::failed, "it crashed"), synthetic_generation("a/mfis", 10),
             synthetic_generation("a/kmeans", 40), synthetic_generation("b/fis", 20)};
  r.cases[3].scene = "b";
  r.config["measure"] = "generation";
  r.config["pdfs_made_by"] = "mfis";
  const auto lines = split(terminal_table(r));
  EXPECT_EQ(lines[0].find("SMAPE"), std::string::npos);
  EXPECT_NE(lines[1].find("failed: it crashed"), std::string::npos);
  EXPECT_NE(lines[2].find(" 10.00 "), std::string::npos);
  EXPECT_NE(lines[2].find(" 2.50 "), std::string::npos);  // the G-buffer half
  EXPECT_NE(lines[2].find(" 7.50 "), std::string::npos);
  EXPECT_TRUE(lines[2].ends_with(" 1"));
  EXPECT_NE(lines[3].find(" 4.000 ["), std::string::npos);
  EXPECT_TRUE(lines[4].ends_with(" 1"));  // another scene
  EXPECT_EQ(signs(lines[0]), signs(lines[3]));
  EXPECT_NE(terminal_table(r).find("PDFs, made by mfis"), std::string::npos);
  const auto rows = split(markdown_table(r));
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(std::count(rows[i].begin(), rows[i].end(), '|'), 6) << rows[i];
}

TEST(Table, SaysWhatTheTimesAreWorth) {
  Report r = synthetic_report();
  EXPECT_NE(terminal_table(r).find("do not compare its times with a GPU's"), std::string::npos);
  EXPECT_NE(terminal_table(r).find("less than 1 % are noise"), std::string::npos);
  EXPECT_EQ(terminal_table(r).find("incomplete"), std::string::npos);
  r.complete = false;
  r.device.type = "discrete";
  EXPECT_NE(terminal_table(r).find("incomplete"), std::string::npos);
  EXPECT_EQ(terminal_table(r).find("do not compare"), std::string::npos);
}

TEST(Table, MarkdownHasSixColumnsInEveryRow) {
  Report r = synthetic_report();
  r.cases[1].error->message = "a | b";
  const auto lines = split(markdown_table(r));
  for (size_t i = 0; i < 5; ++i) {
    size_t bars = 0;
    for (size_t k = 0; k < lines[i].size(); ++k)
      bars += lines[i][k] == '|' && (k == 0 || lines[i][k - 1] != '\\');
    EXPECT_EQ(bars, 7u) << lines[i];
  }
  EXPECT_EQ(split(markdown_table(Report())).size(), 6u);  // heads, rule, two notes
}
