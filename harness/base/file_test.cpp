#include "base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "base/error.h"

namespace fs = std::filesystem;
using namespace vsglbench;

TEST(File, WritesWholeOrNotAtAll) {
  const fs::path dir = fs::temp_directory_path() / ("vsglbench_file_test_" + std::to_string(::getpid()));
  const fs::path path = dir / "sub" / "a.txt";
  write_text(path, "first");
  EXPECT_EQ(read_text(path), "first");
  // A writer that fails half way leaves the old content and no litter.
  EXPECT_THROW(write_atomically(path,
                                [](const fs::path& t) {
                                  std::ofstream(t) << "half";
                                  throw std::runtime_error("disk full");
                                }),
               Error);
  EXPECT_EQ(read_text(path), "first");
  EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
  fs::remove_all(dir);
}

// As `kill -9` does it.
TEST(File, AKilledWriterLeavesTheOldContent) {
  const fs::path dir = fs::temp_directory_path() / fmt::format("vsglbench_killed_test_{}", ::getpid());
  const fs::path path = dir / "page.html";
  write_text(path, "first");
  const pid_t child = ::fork();
  if (child == 0) {
    write_atomically(path, [](const fs::path& temporary) {
      std::ofstream(temporary) << "half";
      ::raise(SIGKILL);
    });
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read_text(path), "first");
  fs::remove_all(dir);
}

TEST(File, AFolderIsRefusedWithoutTheTemporarysName) {
  const fs::path dir = fs::temp_directory_path() / fmt::format("vsglbench_folder_test_{}", ::getpid());
  fs::create_directories(dir / "taken");
  try {
    write_text(dir / "taken", "text");
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()), (dir / "taken").string() + ": is a folder; name a file in it");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), {}), 1);
  fs::remove_all(dir);
}

// A link whose target has no name of its own, as /dev/stdout of a process that writes to a pipe.
TEST(File, ALinkToAPipeIsWrittenTo) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const fs::path link = fs::temp_directory_path() / fmt::format("vsglbench_link_{}", ::getpid());
  fs::create_symlink(fmt::format("/proc/self/fd/{}", ends[1]), link);
  write_text(link, "page");
  char text[8] = {};
  EXPECT_EQ(::read(ends[0], text, sizeof(text)), 4);
  EXPECT_STREQ(text, "page");
  EXPECT_TRUE(fs::is_symlink(link));
  ::close(ends[0]);
  ::close(ends[1]);
  fs::remove(link);
}

TEST(File, APipeIsReadToItsEnd) {
  const fs::path pipe = fs::temp_directory_path() / fmt::format("vsglbench_pipe_{}", ::getpid());
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(100'000, 'x');  // more than it holds at once
  std::thread writer([&] { std::ofstream(pipe) << text; });
  EXPECT_EQ(read_text(pipe), text);
  writer.join();
  fs::remove(pipe);
}

TEST(File, AFullDiskIsAnErrorOfOneLine) {
  try {
    std::ofstream full("/dev/full");
    write_atomically("/dev/full/x", [](const fs::path&) {});
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit_code(), 2);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}
