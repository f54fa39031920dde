#include "papers/page.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.h"

using namespace vsglbench;
namespace fs = std::filesystem;

namespace {

Json trial(const std::string& claim, const std::string& ruling, const std::string& place = "box") {
  return {{"exhibit", "tab1"},   {"claim", claim},    {"source", "[P §1]"}, {"text", "A costs less than B"},
          {"how", "a beside b"}, {"place", place},    {"metric", "rmse"},   {"ruling", ruling},
          {"ratio", 0.5},        {"ci95", {0.4, 0.6}}};
}

Json page_of(const Json& trials) {
  const Json rows = {{{"column", "FIS"},
                      {"name", "Sample"},
                      {"published", "0.5"},
                      {"machine", "GTX"},
                      {"value", 5.0},
                      {"mean", 5.0},
                      {"ci95", {4.9, 5.1}}},
                     {{"column", "FIS"},
                      {"name", "Total"},
                      {"published", "2.0"},
                      {"machine", "GTX"},
                      {"value", 10.0},
                      {"mean", 10.0},
                      {"ci95", {9.9, 10.1}},
                      {"sum", true}}};
  const Json host = {{"cpu", "CPU"}, {"cores", 2}};
  const Json table = {{"scene", "box"}, {"unit", "ms"}, {"rows", rows}};
  const Json exhibit = {{"name", "tab1"},
                        {"source", "[P Tab. 1]"},
                        {"title", "Times"},
                        {"scale", "quick"},
                        {"command", "vsglbench reproduce tab1"},
                        {"commit", "0123456789"},
                        {"dirty", false},
                        {"wall_s", 12.0},
                        {"host", host},
                        {"measured", Json::array()},
                        {"sheet", "tab1.png"},
                        {"problems", Json::array({"room: its asset is absent"})},
                        {"reports", Json::array()},
                        {"tables", Json::array({table})},
                        {"trials", trials}};
  return {{"device", {{"name", "llvm|pipe"}, {"type", "cpu"}, {"driver", "Mesa"}, {"driver_version", "1"}}},
          {"host", host},
          {"exhibits", Json::array({exhibit})}};
}

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST(PapersPage, HasPublishedAndMeasuredSideBySide) {
  const std::string page = papers_page(page_of(Json::array({trial("x", "holds")})));
  EXPECT_EQ(count(page, "| FIS | Sample | 0.5 | 5 [4.9, 5.1] | 10 | 25.0 % | 50.0 % |"), 1u) << page;
  EXPECT_EQ(count(page, "|  | **Total** | 2.0 | 10 [9.9, 10.1] | 5 | 100.0 % | 100.0 % |"), 1u) << page;
  EXPECT_EQ(count(page, "![tab1.png](tab1.png)"), 1u);
  EXPECT_EQ(count(page, "Not made: room: its asset is absent."), 1u);
  EXPECT_EQ(count(page, "llvm|pipe"), 0u);  // would end a cell
}

// What keeps its place on the page may have been measured elsewhere.
TEST(PapersPage, NamesEveryHostOfItsExhibits) {
  Json papers = page_of(Json::array());
  papers["exhibits"].push_back(papers["exhibits"][0]);
  EXPECT_EQ(count(papers_page(papers), "(Mesa 1), CPU with 2 cores: a CPU"), 1u);
  papers["exhibits"][0]["host"]["cpu"] = "Other";
  EXPECT_EQ(count(papers_page(papers), "(Mesa 1), Other with 2 cores and CPU with 2 cores: a CPU"), 1u);
}

TEST(PapersPage, HasNoMarkupOfItsFiles) {
  Json papers = page_of(Json::array({trial("x`<b>", "holds")}));
  papers["exhibits"][0]["title"] = "<script>\x1b[2J|\n# head";
  papers["exhibits"][0]["tables"][0]["rows"][0]["machine"] = "<i>|";
  papers["exhibits"][0]["scale"] = "<u>";
  const std::string page = papers_page(papers);
  for (const char* raw : {"<script", "<b>", "<i>", "<u>", "\x1b", "\n# head"})
    EXPECT_EQ(count(page, raw), 0u) << raw;
}

// A published value that is absent, or 0, has no share and no ratio.
TEST(PapersPage, SharesNeedAPublishedSum) {
  Json papers = page_of(Json::array());
  Json& rows = papers["exhibits"][0]["tables"][0]["rows"];
  for (const char* published : {"", "0"}) {
    rows[1]["published"] = published;
    const std::string page = papers_page(papers);
    EXPECT_EQ(count(page, "inf") + count(page, "nan"), 0u) << page;
  }
}

TEST(PapersPage, TellsAClaimInOneWordAndHowOften) {
  const std::string page = papers_page(page_of(Json::array(
      {trial("x", "holds"), trial("x", "undecided", "room"), trial("y", "holds"),
       trial("y", "does not hold", "room"), trial("z", "does not hold"), trial("u", "undecided")})));
  EXPECT_EQ(count(page, "Of 4 claims: 1 holds, 1 in part, 1 undecided, 1 does not hold."), 1u) << page;
  EXPECT_EQ(count(page, "| **holds** | holds 1, undecided 1 | [tab1](#tab1) |"), 1u) << page;
  EXPECT_EQ(count(page, "| **in part** | holds 1, does not hold 1 | [tab1](#tab1) |"), 1u) << page;
}

TEST(PapersPage, AnExhibitMadeAnewTakesItsPlaceAndLeavesTheOthers) {
  Exhibit first, second, third;
  first.name = "a";
  second.name = "b";
  third.name = "c";
  const Json earlier = {
      {"exhibits", {{{"name", "c"}, {"n", 1}}, {{"name", "a"}, {"n", 1}}, {{"name", "gone"}}}}};
  const Json fresh = {{"exhibits", {{{"name", "b"}, {"n", 2}}, {{"name", "a"}, {"n", 2}}}}};
  const Json out = merged(earlier, fresh, {first, second, third}).at("exhibits");
  ASSERT_EQ(out.size(), 4u);
  EXPECT_EQ(out[3]["name"], "gone");  // of a list that this one does not know
  EXPECT_EQ(out[0], Json({{"name", "a"}, {"n", 2}}));
  EXPECT_EQ(out[1], Json({{"name", "b"}, {"n", 2}}));
  EXPECT_EQ(out[2], Json({{"name", "c"}, {"n", 1}}));
}

// Nobody edits a committed page by hand: it is what its papers.json gives, and its thumbnails are small.
TEST(PapersPage, CommittedOnesAreThoseOfTheirJson) {
  const fs::path folder = fs::path(VSGLBENCH_SOURCE_DIR) / "reports" / "papers";
  size_t pages = 0;
  for (const auto& device : fs::directory_iterator(folder)) {
    ++pages;
    const Json papers = JsonDocument::load(device.path() / "papers.json", ErrorKind::config).root();
    EXPECT_EQ(papers_page(papers), read_text(device.path() / "README.md")) << device.path();
    for (const Json& exhibit : papers.at("exhibits")) {
      if (!exhibit.contains("sheet")) continue;
      const fs::path thumbnail = device.path() / exhibit["sheet"].get<std::string>();
      ASSERT_TRUE(fs::exists(thumbnail)) << thumbnail;
      EXPECT_LE(fs::file_size(thumbnail), 200'000u) << thumbnail;
    }
  }
  EXPECT_GT(pages, 0u);
}

// Of every committed row that is a sum of passes: it agrees with them, and a total with its rows.
TEST(PapersPage, CommittedSumsAgreeWithTheirPasses) {
  const fs::path folder = fs::path(VSGLBENCH_SOURCE_DIR) / "reports" / "papers";
  size_t sums = 0;
  for (const auto& device : fs::directory_iterator(folder)) {
    const Json papers = JsonDocument::load(device.path() / "papers.json", ErrorKind::config).root();
    for (const Json& exhibit : papers.at("exhibits")) {
      const std::string name = exhibit["name"];
      if (name != "mfis16-tab1" && name != "mfis16-tab2") continue;
      for (const Json& table : exhibit.at("tables")) {
        std::map<std::string, double> columns;
        for (const Json& row : table.at("rows")) {
          double passes = 0;
          for (const Json& pass : row.at("passes")) passes += pass.at("mean_ms").get<double>();
          EXPECT_NEAR(row["mean"].get<double>(), passes, 1e-9 * passes) << name << row.dump();
          if (!row.value("sum", false)) {
            columns[row["column"]] += row["mean"].get<double>();
            continue;
          }
          ++sums;
          EXPECT_NEAR(columns[row["column"]], row["mean"].get<double>(), 1e-9 * passes) << name << row.dump();
        }
      }
    }
  }
  EXPECT_GE(sums, 12u);
}

}  // namespace
