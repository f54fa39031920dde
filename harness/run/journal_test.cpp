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
  std::vector<Json> read() const { return Journal(path_).read(); }
  fs::path path_;
};

TEST_F(JournalTest, AnotherProcessReadsWhatWasAppended) {
  Journal journal(path_);
  journal.restart("2024");
  journal.append({{"a", 1}});
  journal.append({{"b", "two\nlines"}});
  ASSERT_EQ(read().size(), 2u);
  EXPECT_EQ(read()[1]["b"], "two\nlines");
  Journal(path_).append(3);
  EXPECT_EQ(read().size(), 3u);
  journal.restart("2024");
  EXPECT_TRUE(read().empty());
}

TEST_F(JournalTest, SaysWhatItIsAbout) {
  EXPECT_TRUE(Journal(path_).header().is_null());
  EXPECT_TRUE(read().empty());
  Journal journal(path_);
  journal.restart({{"created", "2024"}});
  journal.append(1);
  EXPECT_EQ(Journal(path_).header(), (Json{{"created", "2024"}}));
  write_text(path_, "no journal\n{}\n");
  EXPECT_TRUE(Journal(path_).header().is_null());
  write_text(path_, R"({"schema": 3})");
  EXPECT_TRUE(Journal(path_).header().is_null());
}

TEST_F(JournalTest, IsEmptyUntilSomethingIsAppended) {
  EXPECT_TRUE(Journal(path_).is_empty());
  Journal journal(path_);
  journal.restart("2024");
  EXPECT_TRUE(journal.is_empty());
  journal.append(1);
  EXPECT_FALSE(journal.is_empty());
  fs::resize_file(path_, 5);  // killed while it began
  EXPECT_TRUE(journal.is_empty());
}

TEST_F(JournalTest, ALineThatWasCutOffCostsItself) {
  Journal journal(path_);
  journal.restart("2024");
  journal.append({{"a", 1}});
  journal.append({{"b", 2}});
  fs::resize_file(path_, fs::file_size(path_) - 3);
  EXPECT_EQ(read().size(), 1u);
  Journal(path_).append({{"c", 3}});
  ASSERT_EQ(read().size(), 2u);
  EXPECT_EQ(read()[1]["c"], 3);
}

TEST_F(JournalTest, ALinkIsNotFollowed) {
  const fs::path victim = path_.string() + ".victim";
  write_text(victim, "precious");
  fs::create_symlink(victim, path_);
  EXPECT_THROW(Journal(path_).restart({}), Error);
  EXPECT_EQ(read_text(victim), "precious");
  fs::remove(victim);
}

TEST_F(JournalTest, AFolderInItsPlaceIsAnError) {
  EXPECT_THROW(Journal(path_ / "absent" / "file").restart({}), Error);
}

}  // namespace
}  // namespace vsglbench
