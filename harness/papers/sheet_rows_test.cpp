#include "papers/sheet_rows.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "base/file.h"

using namespace vsglbench;
namespace fs = std::filesystem;

namespace {

// A report of two methods with their pictures, 40 × 20 pixels each.
class SheetRows : public ::testing::Test {
 protected:
  SheetRows() : folder_(fs::temp_directory_path() / fmt::format("vsglbench-rows-{}", ::getpid())) {
    fs::create_directories(folder_ / "images");
    for (const char* method : {"fis", "mfis"}) {
      CaseResult c;
      c.scene = "box";
      c.method = method;
      c.id = fmt::format("box/{}/N=16", method);
      c.images = {{"reference", "images/reference.exr"}, {"indirect", fmt::format("images/{}.exr", method)}};
      report_.cases.push_back(c);
    }
    for (const char* name : {"reference", "fis", "mfis"}) write_png(png(name), Bitmap(40, 20));
    part_.run = "tiny";
    part_.images = {"reference", "indirect"};
  }
  ~SheetRows() override { fs::remove_all(folder_); }
  fs::path png(const std::string& name) const { return folder_ / "images" / (name + ".png"); }
  std::vector<SheetRow> rows() { return rows_of(report_, folder_, part_, &problems_); }
  SheetRow files(const std::vector<std::string>& globs) {
    part_.files = globs;
    return files_of(folder_, part_, &problems_);
  }

  const fs::path folder_;
  Report report_;
  SheetPart part_;
  std::vector<std::string> problems_;
};

TEST_F(SheetRows, AreAReferenceAndTheCases) {
  const auto made = rows();
  ASSERT_EQ(made.size(), 1u);
  ASSERT_EQ(made[0].tiles.size(), 3u);
  EXPECT_EQ(made[0].tiles[0].caption, "reference");
  EXPECT_EQ(made[0].tiles[2].caption, "mfis");
  EXPECT_TRUE(problems_.empty());
}

// Damaged or gone: every other picture stays.
TEST_F(SheetRows, APictureThatCantBeReadCostsItsOwnTile) {
  write_text(png("fis"), "no picture");
  const auto made = rows();
  ASSERT_EQ(made.at(0).tiles.size(), 3u);
  EXPECT_EQ(made[0].tiles[1].detail, "can't be read");
  EXPECT_EQ(made[0].tiles[2].picture.width, 40u);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_NE(problems_[0].find("fis.png"), std::string::npos) << problems_[0];
  EXPECT_NE(problems_[0].find("--force"), std::string::npos) << problems_[0];
  fs::remove(png("reference"));
  EXPECT_EQ(rows().at(0).tiles.size(), 3u);
  EXPECT_EQ(problems_.size(), 3u);
  const SheetRow all = files({"*.png"});
  ASSERT_EQ(all.tiles.size(), 2u);
  EXPECT_EQ(all.tiles[0].detail, "can't be read");
  EXPECT_EQ(all.tiles[1].picture.width, 40u);
}

TEST_F(SheetRows, WhatMatchesNothingIsAProblem) {
  EXPECT_EQ(files({"*mfis.png", "*mfsi.png"}).tiles.size(), 1u);
  EXPECT_EQ(problems_, std::vector<std::string>{"tiny: no picture matches '*mfsi.png'"});
  problems_.clear();
  part_.images = {"reference", "indirect", "cancellation"};
  EXPECT_EQ(rows().size(), 1u);
  EXPECT_EQ(problems_,
            std::vector<std::string>{"tiny: no case that matches '*' has a picture 'cancellation'"});
  problems_.clear();
  part_.cases = "*/kmeans/*";
  EXPECT_TRUE(rows().empty());
  EXPECT_EQ(problems_, std::vector<std::string>{"tiny: no case matches '*/kmeans/*'"});
}

// Why a case failed stands elsewhere.
TEST_F(SheetRows, OfFailedCasesNothingIsMissed) {
  for (CaseResult& c : report_.cases) {
    c.status = Status::skipped;
    c.images.clear();
  }
  EXPECT_TRUE(rows().empty());
  EXPECT_TRUE(problems_.empty());
}

}  // namespace
