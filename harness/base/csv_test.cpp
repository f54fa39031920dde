#include "base/csv.h"

#include <gtest/gtest.h>

using namespace vsglbench;

TEST(Csv, QuotesWhatWouldBreakARow) {
  EXPECT_EQ(csv_row("plain", 1.5, 7), "plain,1.5,7\n");
  EXPECT_EQ(csv_row("N=64,rsm=256"), "\"N=64,rsm=256\"\n");
  EXPECT_EQ(csv_row("say \"x\""), "\"say \"\"x\"\"\"\n");
  EXPECT_EQ(csv_row("two\nlines", "\r"), "\"two\nlines\",\"\r\"\n");
  EXPECT_EQ(csv_row("", ""), ",\n");
}

TEST(Csv, ReadsWhatItWrote) {
  const std::vector<std::vector<std::string>> rows = {
      {"case", "a,b", ""}, {"\"", "\"\"", "x\"y,\r\nz"}, {"", "", ""}, {"α", " spaced ", ","}};
  std::string text;
  for (const auto& row : rows) text += csv_row(row);
  EXPECT_EQ(parse_csv(text), rows);
  EXPECT_EQ(parse_csv("a,b\r\n1,2"), (std::vector<std::vector<std::string>>{{"a", "b"}, {"1", "2"}}));
  EXPECT_TRUE(parse_csv("").empty());
}
