// A run that is killed at any moment, and the same command again.
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <thread>

#include "run/journal.h"
#include "run/run_fixture.h"
#include "run/runner.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kKills = 12, kFrames = 16, kCases = 8;  // of each of two scenes
constexpr const char* kUnkept = "frames are not on the disk after a minute";

class SurvivalTest : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // what a killed run leaves behind is this process's
    config_["scenes"] = {"cornell", "ring514"};
    config_["methods"] = {{{"method", "vpl"}}, {{"method", "fis"}}, {{"method", "mfis"}, {"N", {8, 16}}}};
    config_["visibility"] = {"exact", "none"};
    config_["timing"] = {{"min_samples", kFrames}, {"max_samples", kFrames}};
  }

  // In a process of its own, whose actions are kept in a file beside the folder. A timed frame waits until
  // the frames before it are on the disk, but for those that earlier starts have lost: however busy the
  // machine is, its reader keeps up. Whether they come at all is in the diary.
  pid_t start(const fs::path& out, size_t lost = 0) const {
    RunOptions options;
    options.config = write_config();
    options.out = out;
    options.argv = {"vsglbench", "run"};
    options.sabotage = [=, diary = diary_of(out)](const Activity& a) {
      std::ofstream(diary, std::ios::app) << a.case_id + " | " + a.action + "\n";
      if (!a.action.starts_with("frame ")) return;
      const auto are_kept = [&] { return frames_kept(out) + lost + 1 >= frames_begun(out); };
      const auto begin = std::chrono::steady_clock::now();
      while (!are_kept()) {
        if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(60)) {
          std::ofstream(diary, std::ios::app) << kUnkept << "\n";
          ::_exit(3);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
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
  // Timed frames that are on the disk: of a scene that is saved all, those of the A/A twin among them, else
  // what the journal tells.
  static size_t frames_kept(const fs::path& out) {
    std::set<std::string> saved;
    if (fs::exists(out / "report.json")) {
      const Json report = Json::parse(read_text(out / "report.json"));
      for (const Json& scene : report.at("scenes")) saved.insert(scene.at("name"));
    }
    size_t count = saved.size() * kFrames * (kCases + 1);
    for (const Json& line : Journal(out / "report.journal").read())
      if (!saved.contains(line.at("scene")) && line.at("news").contains("frames"))
        count += line["news"]["frames"].size();
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

TEST_F(SurvivalTest, KilledTwelveTimesTheReportIsTheSame) {
  const fs::path whole = folder_ / "whole", killed = folder_ / "killed";
  ASSERT_EQ(wait(start(whole)), 0);

  // In turn at a random action of a start's first, which open cases and look at them, and at a random timed
  // frame; of so few that all starts together can't end the run.
  std::mt19937_64 random(std::random_device{}());
  const auto one_of = [&](size_t most) { return std::uniform_int_distribution<size_t>(1, most)(random); };
  size_t lost = 0;  // frames that were begun and are not on the disk
  for (size_t i = 0; i < kKills; ++i) {
    const auto progress = [&] { return i % 2 == 0 ? lines_of(diary_of(killed)) : frames_begun(killed); };
    const size_t moment = progress() + one_of(i % 2 == 0 ? 40 : frames_begun(whole) / kKills);
    const pid_t pid = start(killed, lost);
    while (progress() < moment) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(pid, SIGKILL);
    ASSERT_EQ(wait(pid), -SIGKILL) << i;
    while (::waitpid(-1, nullptr, 0) > 0) {  // its worker, which is this process's now
    }
    const size_t gone = frames_begun(killed) - frames_kept(killed);
    // The frame in flight, and the one whose times travel with the announcement of that one.
    EXPECT_LE(gone - lost, 2u) << "of kill " << i;
    lost = gone;
  }
  const bool is_open = fs::exists(killed / "report.journal") || !fs::exists(killed / "report.json");
  ASSERT_EQ(is_open ? wait(start(killed, lost)) : 0, 0);
  for (const fs::path& out : {whole, killed})
    EXPECT_EQ(read_text(diary_of(out)).find(kUnkept), std::string::npos) << out;

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
  // What was lost is measured again, and nothing else.
  EXPECT_EQ(frames_begun(killed), frames_begun(whole) + lost);
}

}  // namespace
}  // namespace vsglbench
