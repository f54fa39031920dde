#include "base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

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
