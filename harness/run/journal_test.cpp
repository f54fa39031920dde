#include "run/journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class JournalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::temp_directory_path() / fmt::format("vsglbench_journal_{}", ::getpid());
    fs::remove(path_);
  }
  void TearDown() override { fs::remove(path_); }
  std::vector<Json> read(const std::string& created = "2024") const { return Journal(path_, created).read(); }
  fs::path path_;
};

TEST_F(JournalTest, AnotherProcessReadsWhatWasAppended) {
  Journal journal(path_, "2024");
  journal.restart();
  journal.append({{"a", 1}});
  journal.append({{"b", "two\nlines"}});
  ASSERT_EQ(read().size(), 2u);
  EXPECT_EQ(read()[1]["b"], "two\nlines");
  Journal(path_, "2024").append(3);
  EXPECT_EQ(read().size(), 3u);
  journal.restart();
  EXPECT_TRUE(read().empty());
}

TEST_F(JournalTest, OneOfAnotherReportIsOfNoUse) {
  EXPECT_TRUE(read().empty());
  Journal journal(path_, "2024");
  journal.restart();
  journal.append(1);
  EXPECT_TRUE(read("2025").empty());
}

TEST_F(JournalTest, ALineThatWasCutOffCostsItself) {
  Journal journal(path_, "2024");
  journal.restart();
  journal.append({{"a", 1}});
  journal.append({{"b", 2}});
  fs::resize_file(path_, fs::file_size(path_) - 3);
  EXPECT_EQ(read().size(), 1u);
  Journal(path_, "2024").append({{"c", 3}});
  ASSERT_EQ(read().size(), 2u);
  EXPECT_EQ(read()[1]["c"], 3);
}

TEST_F(JournalTest, AFolderInItsPlaceIsAnError) {
  EXPECT_THROW(Journal(path_ / "absent" / "file", "2024").restart(), Error);
}

}  // namespace
}  // namespace vsglbench
