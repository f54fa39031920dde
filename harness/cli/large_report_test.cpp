// A report of 10,000 cases: everything that reads one stays under 20 s and 1 GiB. Each command is a process
// of its own.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "answer/large_report.h"
#include "base/file.h"
#include "base/test_folders.h"

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

constexpr double kMostSeconds = 20;
constexpr long kMostKiB = 1 << 20;

struct Spent {
  int code = -1;
  double wall_s = 0, processor_s = 0;  // the latter with that of gnuplot
  long peak_kib = 0;
};

Spent run(std::vector<std::string> arguments, const fs::path& out) {
  arguments.insert(arguments.begin(), test_programme().string());
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  std::fflush(nullptr);  // or the child would say it again
  const pid_t pid = ::fork();
  if (pid == 0) {
    if (!std::freopen(out.c_str(), "w", stdout)) ::_exit(126);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  int status = 0;
  rusage used{};
  ::wait4(pid, &status, 0, &used);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, wall.count(),
          seconds(used.ru_utime) + seconds(used.ru_stime), used.ru_maxrss};
}

class LargeReport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / fmt::format("large_report_{}", ::getpid());
    write_report(folder_ / "report.json", large_report(10000));
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static void expect_quick(const std::vector<std::string>& arguments) {
    const Spent spent = run(arguments, folder_ / "out.txt");
    fmt::print("{}: {:.1f} s of processor, {:.1f} s by the clock, {:.0f} MiB\n", arguments.front(),
               spent.processor_s, spent.wall_s, static_cast<double>(spent.peak_kib) / 1024);
    EXPECT_EQ(spent.code, 0);
    EXPECT_LT(spent.processor_s, kMostSeconds);
    EXPECT_LT(spent.peak_kib, kMostKiB);
    EXPECT_GT(fs::file_size(folder_ / "out.txt"), 50u);
  }
  static std::string path() { return (folder_ / "report.json").string(); }
  static inline fs::path folder_;
};

TEST_F(LargeReport, Table) {
  expect_quick({"table", path()});
  expect_quick({"table", path(), "--sort", "-smape", "--format", "csv"});
}
TEST_F(LargeReport, Compare) { expect_quick({"compare", path(), path()}); }
TEST_F(LargeReport, Answer) { expect_quick({"answer", path(), "--time", "5ms"}); }
TEST_F(LargeReport, Analyse) { expect_quick({"analyse", path()}); }
TEST_F(LargeReport, Claims) { expect_quick({"claims", path()}); }
TEST_F(LargeReport, Plot) { expect_quick({"plot", path(), "--out", (folder_ / "plots").string()}); }

}  // namespace
}  // namespace vsglbench
