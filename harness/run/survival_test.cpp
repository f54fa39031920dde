// A run that is killed at any moment, and the same command again.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <thread>

#include "run/run_fixture.h"
#include "run/runner.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kKills = 10, kFrames = 16;

class SurvivalTest : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    config_["scenes"] = {"cornell", "ring514"};
    config_["methods"] = {{{"method", "vpl"}}, {{"method", "fis"}}, {{"method", "mfis"}, {"N", {8, 16}}}};
    config_["visibility"] = {"exact", "none"};
    config_["timing"] = {{"min_samples", kFrames}, {"max_samples", kFrames}};
  }

  // In a process of its own, whose actions are kept in a file beside the folder.
  pid_t start(const fs::path& out) const {
    RunOptions options;
    options.config = write_config();
    options.out = out;
    options.argv = {"vsglbench", "run"};
    options.sabotage = [diary = diary_of(out)](const Activity& a) {
      std::ofstream(diary, std::ios::app) << a.case_id + " | " + a.action + "\n";
    };
    const pid_t pid = ::fork();
    if (pid != 0) return pid;
    ::_exit(run_config(options).exit_code);
  }
  // Its exit code, or minus the signal that ended it.
  static int wait(pid_t pid) {
    int status = 0;
    ::waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  static fs::path diary_of(const fs::path& out) { return out.string() + ".diary"; }
  static size_t lines_of(const fs::path& file) {
    std::ifstream in(file);
    return static_cast<size_t>(
        std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n'));
  }
  // Timed frames that were begun.
  static size_t frames_begun(const fs::path& out) {
    std::ifstream diary(diary_of(out));
    size_t count = 0;
    for (std::string line; std::getline(diary, line);)
      count += line.find(" | frame ") != std::string::npos ? 1 : 0;
    return count;
  }
};

// What no clock is asked for.
Json timeless(const fs::path& out) {
  Json report = Json::parse(read_text(out / "report.json"));
  for (const char* key : {"created", "wall", "aa", "environment", "analysis"}) report.erase(key);
  for (Json& scene : report["scenes"]) scene.erase("clocks");
  for (Json& c : report["cases"]) {
    c.erase("frame");
    for (const char* key : {"gbuffer_ms", "rsm_ms", "total"}) c["generate"].erase(key);
    c.erase("stopping");
    Json names = Json::array();
    for (const Json& pass : c["passes"]) names.push_back({pass["name"], pass["samples_ms"].size()});
    c["passes"] = names;
  }
  return report;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

TEST_F(SurvivalTest, KilledTenTimesTheReportIsTheSame) {
  const fs::path whole = folder_ / "whole", killed = folder_ / "killed";
  ASSERT_EQ(wait(start(whole)), 0);

  // Each at a random action, of so few that ten starts together can't end the run.
  std::mt19937_64 random(std::random_device{}());
  const size_t most = lines_of(diary_of(whole)) / (2 * kKills);
  for (size_t i = 0; i < kKills; ++i) {
    const size_t moment = lines_of(diary_of(killed)) + std::uniform_int_distribution<size_t>(1, most)(random);
    const pid_t pid = start(killed);
    while (lines_of(diary_of(killed)) < moment) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(pid, SIGKILL);
    ASSERT_EQ(wait(pid), -SIGKILL) << i;
  }
  const bool is_open = fs::exists(killed / "report.journal") || !fs::exists(killed / "report.json");
  ASSERT_EQ(is_open ? wait(start(killed)) : 0, 0);

  EXPECT_EQ(timeless(killed), timeless(whole)) << Json::diff(timeless(whole), timeless(killed)).dump(1);
  EXPECT_EQ(files_in(killed), files_in(whole));
  for (const std::string& file : files_in(whole)) {
    if (file.ends_with(".exr")) {
      EXPECT_EQ(read_text(killed / file), read_text(whole / file)) << file;
    }
  }
  const Report report = read_report(killed / "report.json");
  expect_sound(killed / "report.json");
  EXPECT_EQ(report.aa.size(), 2u);
  // The frame at hand, and those before it whose times were on their way: frames of a millisecond, of which a
  // busy machine lets several pass before they are read.
  EXPECT_LE(frames_begun(killed), frames_begun(whole) + 8 * kKills);
}

}  // namespace
}  // namespace vsglbench
