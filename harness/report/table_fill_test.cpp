#include "report/table_fill.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>

#include "base/file.h"
#include "report/synthetic_report.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

class TableFill : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_fill_test_" + std::to_string(::getpid()));
  void SetUp() override { write_report(dir_ / "reports/a/report.json", synthetic_report()); }
  void TearDown() override { fs::remove_all(dir_); }
  std::string filled(const std::string& text) const { return fill_tables(dir_ / "README.md", text).text; }
  std::string problem(const std::string& text) const {
    try {
      filled(text);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      return e.what();
    }
    return "no error";
  }
};

const std::string kText =
    "# Title\n\n<!-- table reports/a/report.json columns=smape,frame only=*/mfis -->\nstale\n<!-- end of "
    "table "
    "-->\n\nprose\n";

}  // namespace

TEST_F(TableFill, ATableStandsBetweenItsMarkers) {
  const std::string text = filled(kText);
  EXPECT_EQ(text.find("stale"), std::string::npos);
  EXPECT_NE(text.find("| cornell mfis | 12.00 ± 0.2 | 27.00 |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("[report](reports/a/report.json) of 2024-05-01, commit aaaaaaa with changes."),
            std::string::npos);
  EXPECT_TRUE(text.starts_with("# Title\n\n<!-- table"));
  EXPECT_TRUE(text.ends_with("<!-- end of table -->\n\nprose\n"));
  EXPECT_EQ(filled(text), text);  // again: nothing changes
}

// What the check is for: a digit in the text, or a number in the report.
TEST_F(TableFill, ADifferentNumberIsFound) {
  const std::string text = filled(kText);
  EXPECT_EQ(first_other_line(text, filled(text)), 0u);
  std::string edited = text;
  edited.replace(edited.find("27.00"), 5, "26.00");
  EXPECT_EQ(first_other_line(edited, filled(edited)), 7u);
  Report r = synthetic_report();
  r.cases[0].frame->span.median = 28;
  write_report(dir_ / "reports/a/report.json", r);
  EXPECT_EQ(first_other_line(text, filled(text)), 7u);
}

TEST_F(TableFill, WhatIsWrongWithAMarker) {
  const auto found = [&](const std::string& text, const std::string& part) {
    const std::string message = problem(text);
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("README.md:2: "), std::string::npos) << message;
  };
  const std::string end = "<!-- end of table -->\n";
  found("\n<!-- table reports/a/report.json -->\n", "has no end");
  found("\n<!-- table reports/a/report.json -->\n<!-- table reports/a/report.json -->\n" + end, "has no end");
  found("\n" + end, "has no beginning");
  found("\n<!-- table reports/a/report.json\n" + end, "must end in -->");
  found("\n<!-- table reports/b/report.json -->\n" + end, "reports/b/report.json");
  found("\n<!-- table reports/a/report.json columns=smap -->\n" + end, "did you mean 'smape'?");
  found("\n<!-- table reports/a/report.json column=smape -->\n" + end, "did you mean 'columns'?");
  found("\n<!-- table reports/a/report.json across=K -->\n" + end, "no part 'K'");
  found("\n<!-- table reports/a/report.json only=x -->\n" + end, "no case of the report matches 'x'");
}

TEST_F(TableFill, FindsTheFilesThatHoldTables) {
  write_text(dir_ / "README.md", kText);
  write_text(dir_ / "deep/README.md", kText);
  write_text(dir_ / "deep/none.md", "no table, but how to write one:\n\n    " + kText.substr(9));
  write_text(dir_ / "build/README.md", kText);
  write_text(dir_ / ".git/README.md", kText);
  EXPECT_EQ(files_with_tables({dir_}), (std::vector<fs::path>{dir_ / "README.md", dir_ / "deep/README.md"}));
  EXPECT_EQ(files_with_tables({dir_ / "deep/none.md"}).size(), 1u);
  EXPECT_THROW(files_with_tables({dir_ / "absent"}), Error);
}
