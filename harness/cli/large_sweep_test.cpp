// 10,000 cases in 200 shards: plan, status and merge stay under 20 s and 1 GiB. Each command is a process of
// its own.
#include <sys/resource.h>

#include <chrono>

#include "answer/large_report.h"
#include "cli/cli_fixture.h"
#include "sweep/plan.h"
#include "sweep/shard_folder.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr double kMostSeconds = 20;
constexpr long kMostKiB = 1 << 20;

class LargeSweepTest : public CliTest {
 protected:
  void expect_quick(const std::vector<std::string>& arguments, int code) const {
    const auto begin = std::chrono::steady_clock::now();
    const RunningProgramme child = start(arguments);
    const std::string out = read_to_end(child.out), err = read_to_end(child.err);
    int status = 0;
    rusage used{};
    ::wait4(child.pid, &status, 0, &used);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    const double processor = seconds(used.ru_utime) + seconds(used.ru_stime);
    fmt::print("{} {}: {:.1f} s of processor, {:.1f} s by the clock, {:.0f} MiB\n{}", arguments[0],
               arguments[1], processor, wall.count(), static_cast<double>(used.ru_maxrss) / 1024,
               out.substr(0, 400));
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, code) << err;
    EXPECT_LT(processor, kMostSeconds);
    EXPECT_LT(used.ru_maxrss, kMostKiB);
  }
  // Of 1000 cases of each of ten scenes.
  void use_large_config() {
    config_["scenes"] = Json::array();
    for (int i = 0; i < 10; ++i)
      config_["scenes"].push_back(write_scene(fmt::format("s{}", i), square_scene(), box_gltf().dump()));
    Json lights = Json::array(), importance = Json::array();
    for (int i = 1; i <= 100; ++i) lights.push_back(i);
    for (int i = 1; i <= 10; ++i) importance.push_back(i);
    config_["methods"] = {{{"method", "vpl"}, {"N", lights}, {"importance_lights", importance}}};
  }
  static void finish(const SweepPlan& plan, size_t shard, const fs::path& sweep, const CaseResult& model,
                     std::mt19937_64* random) {
    const SweepFolder folder(sweep);
    const Shard& s = plan.shards[shard];
    Report r = synthetic_report();
    r.config = plan.config;
    r.config["only"] = exact_globs(s.cases);
    r.git = plan.git;
    r.kernels = plan.kernels;
    r.scenes[0].name = s.scene;
    r.aa[0].scene = s.scene;
    r.cases.clear();
    for (const std::string& id : s.cases) {
      const int n = std::stoi(id.substr(id.find("N=") + 2));
      CaseResult& c = r.cases.emplace_back(
          large_case(model, 0, {{"N", n}, {"rsm", 16}, {"visibility", "exact"}}, "vpl", random));
      c.id = id;
      c.scene = s.scene;
      c.method = "vpl";
    }
    const fs::path work = folder.work(shard, 1);
    write_report(work / "report.json", r);
    HostRecord record{.plan = plan.hash(), .shard = shard, .attempt = 1, .host = "h"};
    record.device = r.device;
    record.cases.ok = r.cases.size();
    record.report_bytes = fs::file_size(work / "report.json");
    write_text(work / "host.json", to_json(record).dump());
    folder.finish(shard, 1);
  }
};

TEST_F(LargeSweepTest, TenThousandCasesInTwoHundredShards) {
  use_large_config();
  const fs::path sweep = folder_ / "sweep";
  expect_quick({"sweep", "plan", write_config().string(), "--out", sweep.string(), "--shards-by", "block:50"},
               0);
  const SweepPlan plan = read_plan(sweep);
  ASSERT_EQ(plan.shards.size(), 200u);
  ASSERT_EQ(plan.case_ids().size(), 10000u);
  expect_quick({"sweep", "status", sweep.string()}, 5);
  std::mt19937_64 random(7);
  const CaseResult model = synthetic_case("s/vpl/");
  for (size_t shard = 0; shard < plan.shards.size(); ++shard) finish(plan, shard, sweep, model, &random);
  expect_quick({"sweep", "status", sweep.string()}, 0);
  expect_quick({"sweep", "merge", sweep.string()}, 0);
}

}  // namespace
}  // namespace vsglbench
