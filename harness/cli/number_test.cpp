// Numbers on the command line that are none, and runs that are interrupted while a plugin holds processes.
#include <csignal>
#include <thread>

#include "cli/cli_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

TEST_F(CliTest, ATimeLimitThatIsNoNumberIsRefused) {
  for (const char* limit : {"nan", "inf", "NAN"}) {
    expect_refused(run({"run", write_config().string(), "--out", out_.string(), "--time-limit", limit}), 2,
                   std::string("--time-limit: "));
    expect_refused(run({"check-method", "vpl", "--time-limit", limit}), 2, std::string("--time-limit: "));
  }
}

TEST_F(CliTest, CtrlCLeavesNoProcessOfAPlugin) {
  const fs::path file = folder_ / "pid", bad = bad_plugins();
  ::setenv("VSGLBENCH_TEST_PID", file.c_str(), 1);
  config_["methods"] = {{{"method", "faulty"}, {"fault", "holds"}}};
  const RunningProgramme child =
      start({"-q", "--plugin-path", bad.string(), "run", write_config().string(), "--out", out_.string()});
  for (int i = 0; i < 6000 && (!fs::exists(file) || fs::is_empty(file)); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::unsetenv("VSGLBENCH_TEST_PID");
  const pid_t held = std::stoi(read_text(file));
  EXPECT_EQ(::kill(held, 0), 0);
  ::kill(child.pid, SIGINT);
  const Finished f = finish(child);  // to the end of its output, which the plugin's process holds too
  EXPECT_EQ(f.signal, SIGINT);
  EXPECT_TRUE(contains(f.err, "interrupted; the same command goes on"));
}

}  // namespace
}  // namespace vsglbench
