// `vsglbench sweep`: from a plan to one report, and what may go wrong on the way.
#include <csignal>
#include <thread>

#include "cli/cli_fixture.h"
#include "image/exr.h"
#include "sweep/attempt.h"
#include "sweep/shard_folder.h"
#include "sweep/untimed.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class SweepCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    sweep_ = folder_ / "sweep";
    config_["scenes"] = {"cornell", "ring514"};
    config_["methods"] = {{{"method", "vpl"}, {"N", {4, 8, 16}}}, {{"method", "mfis"}, {"N", 8}}};
    ::unsetenv("CUDA_VISIBLE_DEVICES");
  }
  Finished call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"-q", "sweep"});
    return run(arguments);
  }
  Finished plan(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"plan", write_config().string(), "--out", sweep_.string()});
    return call(more);
  }
  Finished task(size_t shard, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", sweep_.string(), std::to_string(shard)});
    return call(more);
  }
  Finished status() const { return call({"status", sweep_.string()}); }
  Finished merge() const { return call({"merge", sweep_.string()}); }
  fs::path merged() const {
    for (const auto& entry : fs::directory_iterator(sweep_ / "merged"))
      if (entry.is_directory()) return entry.path();
    return {};
  }
  // One shard whose frames take long enough for somebody to end it.
  void plan_a_long_one() {
    config_["scenes"] = {"cornell"};
    config_["timing"] = {{"min_samples", 100000}, {"max_samples", 100000}, {"time_limit_s", 600}};
    ASSERT_EQ(plan().code, 0);
  }
  // Of its journal: it measures.
  RunningProgramme start_and_wait() const {
    const RunningProgramme task = start({"-q", "sweep", "run", sweep_.string(), "0"});
    const fs::path journal = SweepFolder(sweep_).work(0, 1) / "report.journal";
    for (int i = 0; i < 1200 && !fs::exists(journal); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_TRUE(fs::exists(journal));
    return task;
  }
  fs::path sweep_;
};

// Its images, too, to the bit.
TEST_F(SweepCommand, AMergedReportIsThatOfOneMachineButForTimes) {
  const Finished planned = plan({"--shards-by", "block:2"});
  ASSERT_EQ(planned.code, 0);
  EXPECT_TRUE(contains(planned.out,
                       "8 cases of 2 scenes in 4 shards of 2 to 3 cases, which measure anchors 2 times more"))
      << planned.out;
  EXPECT_EQ(status().code, 5);
  EXPECT_TRUE(contains(status().out, "0 cases of 10 measured")) << status().out;
  for (const size_t shard : {3, 0, 2, 1}) {
    const Finished f = task(shard);
    ASSERT_EQ(f.code, 0) << f.err;
  }
  EXPECT_EQ(status().code, 0);
  EXPECT_TRUE(contains(status().out, "4 shards: 4 done, 0 running, 0 failed, 0 missing\n"));
  const Finished f = merge();
  ASSERT_EQ(f.code, 0) << f.out << f.err;
  ASSERT_EQ(run_config().code, 0);
  const Report one = report(), all = read_report_at(merged());
  expect_sound(merged() / "report.json");
  EXPECT_EQ(untimed(all), untimed(one));
  EXPECT_EQ(all.device.name, one.device.name);
  for (const CaseResult& c : all.cases)
    for (const auto& [name, path] : c.images)
      EXPECT_EQ(read_exr(merged() / path).pixels, read_exr(out_ / path).pixels) << path;
  EXPECT_EQ(run({"table", merged().string()}).code, 0);
  EXPECT_EQ(run({"analyse", merged().string()}).code, 0);
  const Finished compared = run({"compare", out_.string(), merged().string()});
  EXPECT_TRUE(compared.code == 0 || compared.code == 4 || compared.code == 5) << compared.err;
  EXPECT_EQ(compared.out.find("refused"), std::string::npos) << compared.out;
  for (const char* file : {"report.json", "host.json", "attempt-1.log", "images"})
    EXPECT_TRUE(fs::exists(sweep_ / "shards/00002" / file)) << file;
}

TEST_F(SweepCommand, AShardThatIsDoneIsNotMeasuredAgain) {
  config_["scenes"] = {"cornell"};
  ASSERT_EQ(plan().code, 0);
  ASSERT_EQ(task(0).code, 0);
  const auto written = fs::last_write_time(sweep_ / "shards/00000/report.json");
  const Finished again = task(0);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(contains(again.out, "done before"));
  EXPECT_EQ(fs::last_write_time(sweep_ / "shards/00000/report.json"), written);
  expect_refused(task(1), 2, "has shards 0 to 0, and no 1");
}

TEST_F(SweepCommand, AnotherConfigIsNotMeasured) {
  config_["scenes"] = {"cornell"};
  ASSERT_EQ(plan().code, 0);
  config_["seeds"] = 3;
  write_config();
  expect_refused(task(0), 2, "has changed since the sweep was planned");
  EXPECT_TRUE(contains(status().out, "00000 failed  cornell: attempt 1 on "));
  EXPECT_FALSE(fs::exists(sweep_ / "shards/00000"));
}

TEST_F(SweepCommand, ATaskOnTheWrongDeviceReportsNothing) {
  config_["scenes"] = {"cornell"};
  ASSERT_EQ(plan().code, 0);
  expect_refused(task(0, {"--require-device", "NVIDIA H999"}), 6, "and 'NVIDIA H999' is required");
  EXPECT_FALSE(fs::exists(sweep_ / "shards/00000"));
  EXPECT_TRUE(contains(status().out, "'NVIDIA H999' is required"));
  ::setenv("CUDA_VISIBLE_DEVICES", "GPU-01234567-0123-0123-0123-0123456789ab", 1);
  expect_refused(task(0), 6, "Vulkan doesn't know the GPU of CUDA_VISIBLE_DEVICES=GPU-01234567");
  EXPECT_FALSE(fs::exists(sweep_ / "shards/00000"));
  ::unsetenv("CUDA_VISIBLE_DEVICES");
  EXPECT_EQ(task(0).code, 0);
}

TEST_F(SweepCommand, CasesThatFailAreResultsToo) {
  config_["scenes"] = {"cornell"};
  config_["methods"] = {{{"method", "vpl"}}, {{"method", "all-texels"}}};
  config_["time_limit_s"] = 0.001;
  ASSERT_EQ(plan().code, 0);
  EXPECT_EQ(task(0).code, 1);
  EXPECT_EQ(status().code, 1);
  EXPECT_EQ(merge().code, 1);
}

TEST_F(SweepCommand, ATaskThatIsStoppedSaysSo) {
  plan_a_long_one();
  const RunningProgramme task = start_and_wait();
  EXPECT_TRUE(contains(status().out, "00000 running cornell: attempt 1 on "));
  const Finished second = call({"run", sweep_.string(), "0"});
  EXPECT_EQ(second.code, 0);
  EXPECT_TRUE(contains(second.out, "left to attempt 1 on "));
  ::kill(task.pid, SIGTERM);
  EXPECT_EQ(finish(task).signal, SIGTERM);
  EXPECT_TRUE(contains(status().out, "00000 failed  cornell: attempt 1 on "));
  EXPECT_TRUE(contains(status().out, ": stopped by signal 15, Terminated"));
  EXPECT_EQ(merge().code, 5);
}

TEST_F(SweepCommand, ATaskThatIsKilledLeavesNothingThatCounts) {
  plan_a_long_one();
  const RunningProgramme task = start_and_wait();
  ::kill(task.pid, SIGKILL);
  EXPECT_EQ(finish(task).signal, SIGKILL);
  EXPECT_EQ(status().code, 5);
  EXPECT_TRUE(contains(status().out, "its process is gone, and wrote no end"));
  EXPECT_FALSE(fs::exists(sweep_ / "shards/00000"));
}

TEST_F(SweepCommand, ReferencesAreThereBeforeTheShards) {
  const fs::path cache = folder_ / "cache";
  ::setenv("VSGLBENCH_CACHE", cache.c_str(), 1);
  config_["visibility"] = {"exact", "none"};
  config_["scenes"] = {"cornell", "colonnade-dynamic"};
  config_["methods"] = {{{"method", "vpl"}, {"N", 4}}};
  config_["motion"] = {{"frames", 3}, {"seeds", 2}};
  ASSERT_EQ(plan().code, 0);
  const auto count = [&] {
    size_t n = 0;
    for (const auto& entry : fs::directory_iterator(cache / "references"))
      n += entry.path().extension() == ".exr";
    return n;
  };
  for (const char* scene : {"0", "1"}) ASSERT_EQ(call({"references", sweep_.string(), scene}).code, 0);
  const size_t before = count();
  EXPECT_GE(before, 2u + 6u);
  for (const size_t shard : {0, 1}) ASSERT_EQ(task(shard).code, 0);
  EXPECT_EQ(count(), before);
  expect_refused(call({"references", sweep_.string(), "2"}), 2, "has scenes 0 to 1, and no 2");
}

TEST_F(SweepCommand, ResubmitsWhatIsOpen) {
  ASSERT_EQ(plan().code, 0);
  const Finished printed = call({"submit", sweep_.string(), "--engine", "print", "--", "-p", "gpu"});
  EXPECT_EQ(printed.code, 0) << printed.err;
  EXPECT_TRUE(contains(printed.out, "2 shards: 0-1\n"));
  EXPECT_TRUE(contains(read_text(sweep_ / "jobs/submit.sh"), "--array=0-1 -p gpu "));
  ASSERT_EQ(task(0).code, 0);
  expect_refused(call({"submit", sweep_.string(), "--engine", "print"}), 2, "vsglbench sweep resubmit");
  EXPECT_TRUE(contains(call({"resubmit", sweep_.string(), "--engine", "print"}).out, "1 shards: 1\n"));
  EXPECT_TRUE(
      contains(call({"resubmit", sweep_.string(), "--engine", "print", "--require-device", "H999"}).out,
               "2 shards: 0-1\n"));
  ASSERT_EQ(task(1).code, 0);
  EXPECT_TRUE(
      contains(call({"resubmit", sweep_.string(), "--engine", "print"}).out, "no shard is open: 2 done"));
  expect_refused(call({"submit", sweep_.string(), "--engine", "pbs"}), 2, "no engine 'pbs'");
}

}  // namespace
}  // namespace vsglbench
