// The list of exhibits: published values as the texts print them, and nothing named that is not there.
#include "papers/exhibit.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <set>
#include <sstream>

#include "answer/claims.h"
#include "base/error.h"
#include "base/file.h"
#include "papers/measured_table.h"
#include "run/config.h"

using namespace vsglbench;
namespace fs = std::filesystem;

namespace {

const Exhibit& exhibit(const std::string& name) {
  static const std::vector<Exhibit> all = load_exhibits();
  for (const Exhibit& e : all) {
    if (e.name == name) return e;
  }
  throw std::out_of_range(name);
}

// The lines of a text between its table's caption and the next one, cut at tabs.
std::vector<std::vector<std::string>> printed_table(const std::string& file, const std::string& caption,
                                                    const std::string& end) {
  const fs::path path = fs::path(VSGLBENCH_SOURCE_DIR) / ".." / "shared" / "papers" / file;
  std::error_code ec;
  if (!fs::exists(path, ec)) return {};
  const std::string text = read_text(path);
  const size_t from = text.find(caption), to = text.find(end, from + 1);
  std::vector<std::vector<std::string>> out;
  std::istringstream lines(text.substr(from, to - from));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, '\t');) {
      for (const char* mark : {"<b>", "</b>", "<i>", "</i>"}) {
        for (size_t at; (at = cell.find(mark)) != std::string::npos;)
          cell.erase(at, std::string(mark).size());
      }
      if (const size_t at = cell.find("k -means"); at != std::string::npos) cell.erase(at + 1, 1);  // italics
      cells.push_back(cell);
    }
    if (cells.size() > 2) out.push_back(cells);
  }
  return out;
}

std::string column_text(const Exhibit& e, size_t column, size_t row) {
  std::string name = e.table.at(column).rows.at(row).name;
  if (const size_t at = name.find(" (RSM)"); at != std::string::npos) name.resize(at);
  return name + ": " + e.table.at(column).rows.at(row).published;
}

// [MFIS16 Tab. 1, 2]: pairs of a name and a value, column by column.
void expect_as_printed(const Exhibit& e, const std::string& caption, const std::string& end) {
  const auto printed = printed_table("modified-fis-2016.txt", caption, end);
  if (printed.empty()) GTEST_SKIP() << "the text is not on this machine";
  ASSERT_EQ(printed.size(), 8u) << caption;  // heads, six passes, total
  for (size_t column = 0; column < 4; ++column) {
    EXPECT_EQ(printed[0].at(2 * column), e.table.at(column).head);
    for (size_t row = 0; row < 7; ++row) {
      EXPECT_EQ(printed[row + 1].at(2 * column) + " " + printed[row + 1].at(2 * column + 1),
                column_text(e, column, row));
    }
  }
}

TEST(Exhibits, Table1OfMfis16IsAsPrinted) {
  expect_as_printed(exhibit("mfis16-tab1"), "**Tab. 1**", "**Tab. 2**");
}

TEST(Exhibits, Table2OfMfis16IsAsPrinted) {
  expect_as_printed(exhibit("mfis16-tab2"), "**Tab. 2**", "**Tab. 3**");
}

TEST(Exhibits, Table3OfMfis16IsAsPrinted) {
  const Exhibit& e = exhibit("mfis16-tab3");
  const auto printed = printed_table("modified-fis-2016.txt", "**Tab. 3**", "lower row");
  if (printed.empty()) GTEST_SKIP() << "the text is not on this machine";
  ASSERT_EQ(printed.size(), 4u);
  for (size_t column = 0; column < 4; ++column) {
    EXPECT_EQ(printed[0].at(column + 1), e.table.at(column).head);
    for (size_t row = 0; row < 3; ++row) {
      EXPECT_EQ(printed[row + 1].at(0), e.table.at(column).rows.at(row).name);
      EXPECT_EQ(printed[row + 1].at(column + 1), e.table.at(column).rows.at(row).published);
    }
  }
}

TEST(Exhibits, Table1OfVsgl14IsAsPrinted) {
  const Exhibit& e = exhibit("vsgl14-tab1");
  const auto printed = printed_table("vsgl-2014-brief.txt", "Table 1:", "are insufficient");
  if (printed.empty()) GTEST_SKIP() << "the text is not on this machine";
  ASSERT_EQ(printed.size(), 8u);  // figures, heads, six rows
  for (size_t column = 0; column < 4; ++column) {
    const std::string head = e.table.at(column).head;
    EXPECT_TRUE(head.ends_with(printed[1].at(column + 1))) << head;
    for (size_t row = 0; row < 6; ++row) {
      EXPECT_EQ(printed[row + 2].at(0), e.table.at(column).rows.at(row).name);
      EXPECT_EQ(printed[row + 2].at(column + 1), e.table.at(column).rows.at(row).published);
    }
  }
}

// Whatever reads the text: the printed totals are the sums of the printed passes.
TEST(Exhibits, PublishedTotalsAreTheSumsOfTheirPasses) {
  size_t totals = 0;
  for (const char* name : {"mfis16-tab1", "mfis16-tab2"}) {
    for (const PublishedColumn& column : exhibit(name).table) {
      double sum = 0;
      for (const PublishedRow& row : column.rows) {
        if (!row.sum) {
          sum += published_value(row.published);
          continue;
        }
        ++totals;
        EXPECT_NEAR(published_value(row.published), sum, 1.0001e-3) << name << " " << column.head;
      }
    }
  }
  EXPECT_EQ(totals, 8u);
}

TEST(Exhibits, NameClaimsConfigsAndScalesThatExist) {
  std::set<std::string> claims;
  for (const PaperClaim& c : load_claims()) claims.insert(c.name);
  for (const Exhibit& e : load_exhibits()) {
    for (const std::string& name : e.claims) EXPECT_TRUE(claims.contains(name)) << e.name << ": " << name;
    std::set<std::string> sources;
    for (const auto* configs : {&e.runs, &e.lights}) {
      for (const std::string& config : *configs) {
        EXPECT_NO_THROW(load_config(config_path(config))) << config;
        if (configs != &e.runs) continue;
        EXPECT_NO_THROW(load_config(config_path(config), Json::object(), "quick")) << config;
      }
    }
    sources.insert(e.runs.begin(), e.runs.end());
    for (const std::string& config : e.lights) sources.insert(config + "-lights");
    sources.insert(e.figure);
    for (const SheetPart& part : e.sheet) {
      EXPECT_TRUE(sources.contains(part.run)) << e.name << ": sheet of " << part.run;
      EXPECT_NE(part.images.empty(), part.files.empty()) << e.name;
    }
    EXPECT_FALSE(e.runs.empty() && e.lights.empty() && e.figure.empty() && !e.code_size) << e.name;
  }
}

// Every table and figure of the texts has an exhibit.
TEST(Exhibits, CoverTheTexts) {
  std::set<std::string> names;
  for (const Exhibit& e : load_exhibits()) names.insert(e.name);
  for (const char* name :
       {"mfis16-tab1", "mfis16-tab2", "mfis16-tab3", "mfis16-fig1", "mfis16-fig4", "mfis16-fig5",
        "mfis16-fig6", "mfis16-fig7", "mfis16-fig8", "vsgl14-tab1", "vsgl14-fig1", "vsgl14-fig2",
        "vsgl14-fig3", "vsgl14-fig4", "vsgl14-fig6", "sgl22-fig1", "sgl22-fig2", "sgl22-fig3", "sgl22-fig4"})
    EXPECT_TRUE(names.contains(name)) << name;
}

// What `load_exhibits` says of an exhibit with these parts; "" where it takes it.
std::string refusal(const std::string& parts) {
  const fs::path path = fs::temp_directory_path() / fmt::format("exhibit_test_{}.json", ::getpid());
  write_text(path,
             "{\"exhibits\": [{\"name\": \"x\", \"source\": \"s\", \"title\": \"t\",\n" + parts + "}]}");
  std::string out;
  try {
    load_exhibits(path);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::config);
    out = e.what();
  }
  fs::remove(path);
  return out;
}

void expect_refusal(const std::string& parts, const std::string& why) {
  const std::string said = refusal(parts);
  EXPECT_NE(said.find(why), std::string::npos) << "'" << said << "' of " << parts;
  EXPECT_NE(said.find(":2: "), std::string::npos) << said;
}

TEST(Exhibits, ASheetOfWhatIsNotMadeIsRefusedByItsLine) {
  const std::string made = R"("runs": ["mfis16-fig5"], "lights": ["mfis16-fig1"], )";
  const auto sheet = [&](const std::string& part) { return made + "\"sheet\": [" + part + "]"; };
  EXPECT_EQ(refusal(sheet(R"({"run": "mfis16-fig5", "images": ["indirect"]})")), "");
  EXPECT_EQ(refusal(sheet(R"({"run": "mfis16-fig1-lights", "files": ["*"]})")), "");
  expect_refusal(sheet(R"({"run": "mfis16-fig55", "images": ["indirect"]})"),
                 "'x' makes no 'mfis16-fig55'; did you mean 'mfis16-fig5'?");
  expect_refusal(sheet(R"({"run": "mfis16-fig5", "images": ["indirekt"]})"), "indirekt");
  expect_refusal(sheet(R"({"run": "mfis16-fig1-lights", "images": ["indirect"]})"), "give files");
  expect_refusal(sheet(R"({"run": "mfis16-fig5"})"), "shows nothing");
  expect_refusal(R"("lights": ["mfis16-fig1"], "largest_kernel": true)", "name one in runs");
}

TEST(Exhibits, ConfigsThatWouldShareAFolderAreRefused) {
  EXPECT_EQ(refusal(R"("runs": ["a/tiny.json"], "lights": ["a/tiny.json"])"), "");
  EXPECT_EQ(refusal(R"("runs": ["a/tiny.json", "a/../a/tiny.json"])"), "");
  expect_refusal(R"("runs": ["a/tiny.json", "b/tiny.json"])", "'b/tiny.json' would share the folder 'tiny'");
  expect_refusal(R"("runs": ["a/tiny-lights.json"], "lights": ["a/tiny.json"])", "the folder 'tiny-lights'");
  expect_refusal(R"("runs": ["a/tiny.json"], "figure": "b/tiny.json")", "the folder 'tiny'");
  expect_refusal(R"("runs": ["a/code-size.json"])", "the sizes of code");
}

TEST(Exhibits, AMisspeltNameIsMetWithTheNearest) {
  try {
    select_exhibits(load_exhibits(), {"mfis16-tab4x"});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(e.what()).find("mfis16-tab"), std::string::npos) << e.what();
  }
  EXPECT_EQ(select_exhibits(load_exhibits(), {"mfis16-fig8", "mfis16-tab1"}).front().name, "mfis16-tab1");
  EXPECT_EQ(select_exhibits(load_exhibits(), {"all"}).size(), load_exhibits().size());
}

}  // namespace
