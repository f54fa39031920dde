// Tests only: sweeps whose shards were never measured.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.h"
#include "report/synthetic_report.h"
#include "sweep/attempt.h"
#include "sweep/plan.h"
#include "sweep/shard_folder.h"

namespace vsglbench {

// `shards` of `scene` with `cases` each, named by their numbers.
inline std::vector<Shard> made_shards(const std::string& scene, size_t shards, size_t cases,
                                      size_t from = 0) {
  std::vector<Shard> out;
  for (size_t s = 0; s < shards; ++s) {
    Shard shard{scene, {}, ""};
    for (size_t c = 0; c < cases; ++c)
      shard.cases.push_back(fmt::format("{}/mfis/N={}", scene, from + s * cases + c));
    out.push_back(std::move(shard));
  }
  return out;
}

// One scene in blocks, each with the first case in front.
inline std::vector<Shard> made_blocks(const std::string& scene, size_t shards, size_t cases) {
  std::vector<Shard> out = made_shards(scene, shards, cases);
  const std::string anchor = out.front().cases.front();
  for (Shard& shard : out) {
    shard.anchor = anchor;
    if (shard.cases.front() != anchor) shard.cases.insert(shard.cases.begin(), anchor);
  }
  return out;
}

class MadeSweep {
 public:
  MadeSweep(std::filesystem::path root, std::vector<Shard> shards) : folder(std::move(root)) {
    plan.created = "2024-05-01T12:00:00Z";
    plan.folder = "/";
    plan.run.config = "/config.json";
    plan.config_hash = std::string(32, 'c');
    plan.config = {{"name", "made"}};
    plan.git = {std::string(40, 'a'), false};
    plan.kernels = std::string(32, 'b');
    plan.kernel_sources = std::string(32, 'd');
    plan.plugins = {{"mfis", std::string(32, 'e')}};
    plan.shards_by = "scene";
    plan.shards = std::move(shards);
    write_plan(folder.root(), plan);
  }

  // As a run of the shard writes it. Times are `slower` times those of others.
  Report report(size_t shard, double slower = 1) const {
    const Shard& s = plan.shards[shard];
    Report r = synthetic_report();
    r.config = plan.config;
    r.config["only"] = exact_globs(s.cases);
    r.git = plan.git;
    r.kernels = plan.kernels;
    r.scenes[0].name = s.scene;
    r.scenes[0].hash = "hash of " + s.scene;
    r.scenes[0].effects_priced.reset();
    r.aa[0].scene = s.scene;
    r.aa[0].case_id = s.cases.front();
    r.cases.clear();
    for (const std::string& id : s.cases) {
      CaseResult& c = r.cases.emplace_back(synthetic_case(id));
      c.scene = s.scene;
      for (double& ms : c.frame->method->samples) ms *= slower;
    }
    return r;
  }

  std::filesystem::path work(size_t shard, const Report& report, size_t attempt = 1) const {
    const std::filesystem::path work = folder.work(shard, attempt);
    write_report(work / "report.json", report);
    HostRecord record{.plan = plan.hash(),
                      .shard = shard,
                      .attempt = attempt,
                      .host = "h",
                      .node = fmt::format("n{}", shard)};
    record.device = report.device;
    record.uuid = std::string(32, '1');
    record.seconds = 10;
    record.report_bytes = std::filesystem::file_size(work / "report.json");
    for (const CaseResult& c : report.cases)
      ++(c.status == Status::ok ? record.cases.ok : record.cases.failed);
    write_text(work / "host.json", to_json(record).dump());
    return work;
  }
  std::filesystem::path finish(size_t shard, const Report& report, size_t attempt = 1) const {
    work(shard, report, attempt);
    return folder.finish(shard, attempt);
  }
  std::filesystem::path finish(size_t shard) const { return finish(shard, report(shard)); }

  // An attempt of a process of another machine, silent since so many seconds.
  void attempt_elsewhere(size_t shard, size_t number, double silent_s) const {
    const std::filesystem::path lock = folder.attempts(shard) / fmt::format("attempt-{}.lock", number);
    write_text(lock, Json{{"host", "far"},
                          {"node", "n9"},
                          {"job", ""},
                          {"space", "another boot"},
                          {"pid", 1},
                          {"started_ticks", 1},
                          {"started", "2024-05-01T12:00:00Z"}}
                         .dump());
    std::filesystem::last_write_time(lock,
                                     std::filesystem::file_time_type::clock::now() -
                                         std::chrono::milliseconds(static_cast<int64_t>(1000 * silent_s)));
  }

  SweepFolder folder;
  SweepPlan plan;
};

class SweepTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = std::filesystem::temp_directory_path() /
            fmt::format("vsglbench_sweep_{}_{}_{}", test->test_suite_name(), test->name(), ::getpid());
    std::filesystem::remove_all(root_);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }
  static ::testing::AssertionResult holds(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "'" << text << "' does not contain '" << part << "'";
  }
  std::filesystem::path root_;
};

}  // namespace vsglbench
