// Sweeps by real engines, disturbed: four nodes of Slurm, of which one dies, one is of another class of
// device; and GNU parallel. Slow; needs the packages of `ci/setup slurm`, and root for Slurm's daemons.
#include <csignal>
#include <functional>
#include <set>
#include <thread>

#include "cli/cli_fixture.h"
#include "image/exr.h"
#include "sweep/attempt.h"
#include "sweep/plan.h"
#include "sweep/shard_folder.h"
#include "sweep/untimed.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr const char* kWanted = "256 bits";  // in the name of every node's device but n3's

class SweepEngines : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    sweep_ = folder_ / "sweep";
    ::unsetenv("CUDA_VISIBLE_DEVICES");
    if (!device_is_wanted()) GTEST_SKIP() << "needs lavapipe with vectors of " << kWanted;
    // Twelve shards of a few seconds each.
    config_["scenes"] = {"cornell", "ring514", "colonnade"};
    config_["methods"] = {{{"method", "vpl"}, {"N", {2, 4, 8, 16, 32}}},
                          {{"method", "mfis"}, {"N", {4, 8, 16}}}};
    config_["timing"] = {{"min_samples", 60}, {"max_samples", 60}, {"time_limit_s", 600}};
    const Finished f =
        call({"plan", write_config().string(), "--out", sweep_.string(), "--shards-by", "block:2"});
    ASSERT_EQ(f.code, 0) << f.err;
    ASSERT_EQ(read_plan(sweep_).shards.size(), 12u);
  }
  bool device_is_wanted() const { return run({"list", "devices"}).out.find(kWanted) != std::string::npos; }
  Finished call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"-q", "sweep"});
    return run(arguments);
  }
  Json status() const { return Json::parse(call({"status", sweep_.string(), "--json"}).out); }
  std::string status_text() const { return call({"status", sweep_.string()}).out; }

  static std::string shell(const std::string& command) {
    FILE* pipe = ::popen(command.c_str(), "r");
    std::string out;
    char part[4096];
    for (size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) out.append(part, n);
    ::pclose(pipe);
    return out;
  }

  struct Running {
    size_t shard = 0;
    AttemptOwner owner;
  };
  // Holds a task that measures, so that it can't be done before its bad end comes; false where it is too
  // late.
  static bool hold(const Running& task, const fs::path& work) {
    const auto measures = [&] { return fs::exists(work / "report.journal"); };
    if (!measures()) return false;
    ::kill(static_cast<pid_t>(task.owner.pid), SIGSTOP);
    if (measures()) return true;
    ::kill(static_cast<pid_t>(task.owner.pid), SIGCONT);
    return false;
  }
  static void end(const Running& task, int signal) {
    ::kill(static_cast<pid_t>(task.owner.pid), signal);
    ::kill(static_cast<pid_t>(task.owner.pid), SIGCONT);
  }
  // A task that measures, where `wanted`, held; waits for one.
  Running running(const std::function<bool(const Running&)>& wanted) const {
    for (int i = 0; i < 1200; ++i) {
      for (size_t shard = 0; shard < 12; ++shard) {
        for (const Attempt& a : attempts_in(SweepFolder(sweep_).attempts(shard))) {
          const Running r{shard, a.owner};
          if (a.alive && wanted(r) && hold(r, SweepFolder(sweep_).work(shard, a.number))) return r;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << "no such task:\n" << status_text();
    return {};
  }

  // The shards that are not done, or done on another device alone, as "2,5-6".
  std::set<size_t> open_on_wanted() const {
    std::set<size_t> open;
    const Json now = status();
    for (const Json& s : now.at("shards")) {
      bool done = false;
      for (const Json& f : s.at("folders"))
        done = done ||
               f.at("host").at("device").at("name").get<std::string>().find(kWanted) != std::string::npos;
      if (!done) open.insert(s.at("shard").get<size_t>());
    }
    return open;
  }
  static std::set<size_t> numbers_of(const std::string& list) {
    std::set<size_t> out;
    std::istringstream ranges(list);
    for (std::string range; std::getline(ranges, range, ',');) {
      const size_t dash = range.find('-'), first = std::stoul(range);
      const size_t last = dash == std::string::npos ? first : std::stoul(range.substr(dash + 1));
      for (size_t i = first; i <= last; ++i) out.insert(i);
    }
    return out;
  }
  // "5 shards: 2,5-8" of what submit and resubmit print.
  static std::set<size_t> submitted(const Finished& f) {
    const size_t at = f.out.find(" shards: ");
    if (at == std::string::npos) return {};
    return numbers_of(f.out.substr(at + 9, f.out.find('\n', at) - at - 9));
  }
  size_t attempts_of(size_t shard) const { return attempts_in(SweepFolder(sweep_).attempts(shard)).size(); }

  Json merge(int code) const {
    const Finished f = call({"merge", sweep_.string()});
    EXPECT_EQ(f.code, code) << f.out << f.err;
    std::fputs(f.out.c_str(), stdout);
    return Json::parse(read_text(sweep_ / "merged/merge.json"));
  }
  static void expect_classes_apart(const Json& merged) {
    ASSERT_EQ(merged.at("classes").size(), 2u);
    EXPECT_NE(merged["classes"][0]["device"]["name"], merged["classes"][1]["device"]["name"]);
    EXPECT_NE(merged["classes"][0]["device"]["subgroup_size"],
              merged["classes"][1]["device"]["subgroup_size"]);
  }
  // As an undisturbed run of this machine, images to the bit.
  void expect_as_one_run(const fs::path& merged) {
    ASSERT_EQ(run_config().code, 0);
    const Report one = report(), all = read_report_at(merged);
    expect_sound(merged / "report.json");
    EXPECT_EQ(untimed(all), untimed(one));
    for (const CaseResult& c : all.cases) {
      for (const auto& [name, path] : c.images)
        EXPECT_EQ(read_exr(merged / path).pixels, read_exr(out_ / path).pixels) << path;
    }
    EXPECT_EQ(run({"plot", merged.string(), "--out", (folder_ / "plots").string()}).code, 0);
    EXPECT_EQ(run({"table", merged.string()}).code, 0);
  }
  fs::path sweep_;
};

// Slurm's daemons for as long as the test lasts.
class SweepSlurm : public SweepEngines {
 protected:
  void SetUp() override {
    SweepEngines::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (::geteuid() != 0) GTEST_SKIP() << "Slurm's daemons want root";
    slurm_ = folder_ / "slurm";
    ASSERT_EQ(std::system((daemons() + " start " + slurm_.string()).c_str()), 0);
    ::setenv("SLURM_CONF", (slurm_ / "slurm.conf").c_str(), 1);
  }
  void TearDown() override {
    if (!slurm_.empty()) {
      EXPECT_EQ(std::system((daemons() + " stop " + slurm_.string()).c_str()), 0);
    }
    SweepEngines::TearDown();
  }
  static std::string daemons() { return VSGLBENCH_SOURCE_DIR "/ci/slurm-daemons"; }
  void await_empty_queue() const {
    for (int i = 0; i < 3000 && !shell("squeue -h").empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(shell("squeue -h"), "");
  }
  // With its daemon, the task's keeper, and the task: as when the power fails.
  void kill_node(const std::string& node, const Running& task) const {
    const std::string job = shell("squeue -h -w " + node + " -o %A | head -1");
    shell("kill -9 " + read_text(slurm_ / (node + ".pid")));
    shell("kill -9 $(pgrep -f 'slurmstepd: .'" + job.substr(0, job.find('\n')) + "'\\.')");
    end(task, SIGKILL);
  }
  fs::path slurm_;
};

TEST_F(SweepSlurm, ADisturbedSweepBecomesTheReportOfOneMachine) {
  // 1. All shards, on nodes of two classes; a node, a task and a job come to a bad end.
  Finished f = call({"submit", sweep_.string(), "--engine", "slurm", "--", "--no-requeue"});
  ASSERT_EQ(f.code, 0) << f.out << f.err;
  EXPECT_EQ(submitted(f).size(), 12u);
  const auto on = [](const std::string& node) {
    return [=](const Running& r) { return r.owner.node == node; };
  };
  const Running lost = running(on("n1"));
  kill_node("n1", lost);
  const Running crashed = running(on("n0"));
  end(crashed, SIGSEGV);
  const Running cancelled = running(on("n2"));
  shell("scancel " + cancelled.owner.job);
  await_empty_queue();

  // 2. Each is named, and nothing of them is in a report; nor are two classes in one.
  std::string text = status_text();
  std::fputs(text.c_str(), stdout);
  const auto failed = [&](const Running& r, const std::string& why) {
    EXPECT_TRUE(contains(text, fmt::format("{} failed  {}: attempt 1 on {}: {}", shard_name(r.shard),
                                           read_plan(sweep_).shards[r.shard].scene, r.owner.node, why)));
  };
  failed(lost, "its process is gone, and wrote no end");
  failed(crashed, "its process is gone, and wrote no end");
  failed(cancelled, "stopped by signal 15, Terminated");
  EXPECT_TRUE(contains(text, "128 bits"));
  Json merged = merge(5);
  expect_classes_apart(merged);
  EXPECT_EQ(merged.at("missing").size(), 3u);

  // 3. What is missing is run again, and that alone; a node of the other class reports nothing.
  std::set<size_t> open = open_on_wanted();
  EXPECT_GE(open.size(), 4u);
  f = call(
      {"resubmit", sweep_.string(), "--engine", "slurm", "--require-device", kWanted, "--", "--no-requeue"});
  ASSERT_EQ(f.code, 0) << f.out << f.err;
  EXPECT_EQ(submitted(f), open);
  await_empty_queue();
  text = status_text();
  std::fputs(text.c_str(), stdout);
  EXPECT_FALSE(open_on_wanted().empty());
  EXPECT_TRUE(contains(text + call({"status", sweep_.string(), "--json"}).out, "on n3"));
  std::set<size_t> refused;  // by n3's tasks
  for (size_t shard = 0; shard < 12; ++shard)
    for (const Attempt& a : attempts_in(SweepFolder(sweep_).attempts(shard)))
      if (a.end && a.end->exit_code == 6) refused.insert(shard);
  EXPECT_EQ(refused, open_on_wanted());
  for (size_t shard = 0; shard < 12; ++shard) EXPECT_EQ(attempts_of(shard), open.contains(shard) ? 2u : 1u);

  // 4. Without that node, the rest.
  open = open_on_wanted();
  f = call(
      {"resubmit", sweep_.string(), "--engine", "slurm", "--require-device", kWanted, "--", "--exclude=n3"});
  ASSERT_EQ(f.code, 0) << f.out << f.err;
  EXPECT_EQ(submitted(f), open);
  await_empty_queue();
  merged = merge(0);
  expect_classes_apart(merged);
  EXPECT_EQ(merged["classes"][0]["shards"].size(), 12u);
  EXPECT_EQ(merged["classes"][0]["drift"].size(), 3u);
  expect_as_one_run(sweep_ / "merged" / merged["classes"][0]["folder"].get<std::string>());
}

// A node that dies gives its task to another by Slurm's own requeue.
TEST_F(SweepSlurm, ARequeuedTaskTakesTheShardOver) {
  ASSERT_EQ(call({"submit", sweep_.string(), "--engine", "slurm", "--require-device", kWanted, "--",
                  "--exclude=n3"})
                .code,
            0);
  const Running lost = running([](const Running& r) { return r.owner.node == "n1"; });
  kill_node("n1", lost);
  await_empty_queue();
  EXPECT_EQ(attempts_of(lost.shard), 2u);
  const Json merged = merge(0);
  EXPECT_EQ(merged["classes"].size(), 1u);
  EXPECT_TRUE(merged["classes"][0]["duplicates"].empty());
}

TEST_F(SweepEngines, GnuParallelDisturbedBecomesTheReportOfOneMachine) {
  // Three tasks at a time, and a fourth machine of another class that takes the last shard by itself.
  const RunningProgramme all =
      start({"-q", "sweep", "submit", sweep_.string(), "--engine", "parallel", "--", "--jobs", "3"});
  std::set<size_t> ended;
  const auto next = [&] {
    const Running r = running([&](const Running& x) { return !ended.contains(x.shard); });
    ended.insert(r.shard);
    return r;
  };
  const Running lost = next();
  end(lost, SIGKILL);
  const Running crashed = next();
  end(crashed, SIGSEGV);
  const Running stopped = next();
  end(stopped, SIGTERM);
  ::setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  const Finished other = call({"run", sweep_.string(), "11"});
  ::unsetenv("LP_NATIVE_VECTOR_WIDTH");
  EXPECT_TRUE(other.code == 0 || other.code == 1) << other.err;  // cases that fail there are results, too
  const Finished f = finish(all);
  EXPECT_EQ(f.code, 1) << f.out << f.err;
  EXPECT_TRUE(contains(f.err, "not every task went well"));

  std::string text = status_text();
  std::fputs(text.c_str(), stdout);
  for (const Running& r : {lost, crashed})
    EXPECT_TRUE(contains(text, fmt::format("{} failed  {}: attempt 1 on ", shard_name(r.shard),
                                           read_plan(sweep_).shards[r.shard].scene)));
  EXPECT_TRUE(contains(text, "its process is gone, and wrote no end"));
  EXPECT_TRUE(contains(text, "stopped by signal 15, Terminated"));
  Json merged = merge(5);
  expect_classes_apart(merged);
  const std::set<size_t> open = open_on_wanted();
  EXPECT_EQ(open, (std::set<size_t>{lost.shard, crashed.shard, stopped.shard, 11}));
  const Finished again =
      call({"resubmit", sweep_.string(), "--engine", "parallel", "--require-device", kWanted});
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_EQ(submitted(again), open);
  merged = merge(0);
  expect_classes_apart(merged);
  EXPECT_EQ(merged["classes"][0]["shards"].size(), 12u);
  expect_as_one_run(sweep_ / "merged" / merged["classes"][0]["folder"].get<std::string>());
}

}  // namespace
}  // namespace vsglbench
