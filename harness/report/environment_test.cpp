#include "report/environment.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <regex>

#include "base/file.h"

namespace fs = std::filesystem;
using namespace vsglbench;

TEST(Environment, DescribesTheHost) {
  const HostInfo host = host_info();
  EXPECT_FALSE(host.cpu.empty());
  EXPECT_NE(host.os.find("Linux"), std::string::npos);
  EXPECT_GE(host.cores, 1u);
  EXPECT_GT(host.memory_bytes, 100u << 20);
}

// uptime(1) prints the same three means.
TEST(Environment, TheLoadIsOneMinutes) {
  const auto load = load_average();
  ASSERT_TRUE(load);
  double means[3] = {};
  ASSERT_EQ(::getloadavg(means, 3), 3);
  EXPECT_NEAR(*load, means[0], 0.25 + 0.1 * means[0]);  // it moves on between the two looks
}

TEST(Environment, TheCommitIsWholeOrUnknown) {
  EXPECT_TRUE(std::regex_match(build_git().commit, std::regex("[0-9a-f]{40}|unknown"))) << build_git().commit;
}

TEST(Environment, ACopyOutsideACheckoutHasNoCommit) {
  const fs::path dir = fs::temp_directory_path() / ("vsglbench_git_test_" + std::to_string(::getpid()));
  fs::create_directories(dir);
  const std::string command =
      fmt::format("cmake -DSOURCE={0} -DHEADER={0}/git.h -P {1}/harness/report/git_state.cmake", dir.string(),
                  VSGLBENCH_SOURCE_DIR);
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_text(dir / "git.h"),
            "#define VSGLBENCH_GIT_COMMIT \"unknown\"\n#define VSGLBENCH_GIT_DIRTY false\n");
  fs::remove_all(dir);
}
