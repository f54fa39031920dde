// Faults of a plugin (cli/bad_plugins/faulty.cpp): each costs its own case, in one line, and nothing else.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "method/registry.h"
#include "run/run_fixture.h"
#include "run/runner.h"
#include "run/scene_workers.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

const fs::path kBad = bad_plugins();
// Before any test looks for methods: what was found is kept for the process.
const bool kFindsThem = ::setenv("VSGLBENCH_PLUGINS", kBad.c_str(), 1) == 0;

class PluginFault : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    ASSERT_TRUE(kFindsThem);
    ::setenv("VSGLBENCH_TEST_PID", (folder_ / "pid").c_str(), 1);
    config_["N"] = 8;
  }
  void TearDown() override {
    for (const char* name : {"VSGLBENCH_TEST_PID", "VSGLBENCH_TEST_MISTAKE"}) ::unsetenv(name);
    RunFixture::TearDown();
  }
  // vpl, a case of each fault, and vpl again.
  RunOutcome run(const std::vector<std::string>& faults, const fs::path& out = {}) {
    config_["methods"] = Json::array({{{"method", "vpl"}}});
    for (const auto& fault : faults) config_["methods"].push_back({{"method", "faulty"}, {"fault", fault}});
    config_["methods"].push_back({{"method", "mfis"}});
    RunOptions options;
    options.config = write_config();
    options.out = out.empty() ? out_ : out;
    options.argv = {"vsglbench", "run"};
    return run_config(options);
  }
  // What each fault makes of its case; the others are well, and the report is sound.
  void expect_failures(const std::vector<std::string>& faults, ErrorKind kind,
                       const std::vector<std::string>& messages) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run(faults).exit_code, 1);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(120));
    expect_sound(out_ / "report.json");
    const Report r = read_report(out_ / "report.json");
    EXPECT_TRUE(r.complete);
    ASSERT_EQ(r.cases.size(), faults.size() + 2);
    for (const size_t i : {size_t{0}, r.cases.size() - 1}) EXPECT_EQ(r.cases[i].status, Status::ok);
    for (size_t i = 0; i < faults.size(); ++i) {
      SCOPED_TRACE(faults[i]);
      const CaseResult& c = r.cases[i + 1];
      ASSERT_EQ(c.status, Status::failed);
      EXPECT_EQ(name(c.error->kind), name(kind)) << c.error->message;
      EXPECT_TRUE(contains(c.error->message, messages[i]));
      EXPECT_LT(c.error->message.size(), 600u);
      EXPECT_TRUE(std::none_of(c.error->message.begin(), c.error->message.end(),
                               [](char b) { return static_cast<unsigned char>(b) < 0x20; }));
    }
  }
  // One case an entry of `methods`, between two sound ones: each fails with its message.
  void expect_refusals(const std::vector<Json>& methods, ErrorKind kind,
                       const std::vector<std::string>& messages) {
    config_["methods"] = Json::array({{{"method", "vpl"}}});
    for (const Json& method : methods) config_["methods"].push_back(method);
    config_["methods"].push_back({{"method", "mfis"}});
    RunOptions options{.config = write_config(), .out = out_, .argv = {"vsglbench", "run"}};
    EXPECT_EQ(run_config(options).exit_code, 1);
    expect_sound(out_ / "report.json");
    const Report r = read_report(out_ / "report.json");
    ASSERT_EQ(r.cases.size(), methods.size() + 2);
    for (const size_t i : {size_t{0}, r.cases.size() - 1}) {
      EXPECT_EQ(r.cases[i].status, Status::ok) << r.cases[i].error->message;
    }
    for (size_t i = 0; i < methods.size(); ++i) {
      ASSERT_EQ(r.cases[i + 1].status, Status::failed) << methods[i];
      EXPECT_EQ(name(r.cases[i + 1].error->kind), name(kind));
      EXPECT_TRUE(contains(r.cases[i + 1].error->message, messages[i]));
      EXPECT_EQ(r.cases[i + 1].error->message.find('\n'), std::string::npos);
    }
  }
  std::string refused(const std::string& mistake) {
    ::setenv("VSGLBENCH_TEST_MISTAKE", mistake.c_str(), 1);
    const std::string why = inspect_plugin(kBad / "faulty.so").refused;
    EXPECT_EQ(why.find('\n'), std::string::npos);
    return why;
  }
};

TEST_F(PluginFault, ForeignBytesInThePipeEndTheWorker) {
  expect_failures({"garbage", "forged"}, ErrorKind::crashed,
                  {"sent what is no message", "sent what is no message"});
}

TEST_F(PluginFault, AClosedPipeAndAnOrphanAreNotWaitedFor) {
  expect_failures({"closes", "orphan"}, ErrorKind::crashed, {"closed its pipe and went on", "signal 9"});
  const pid_t orphan = std::stoi(read_text(folder_ / "pid"));
  std::string state = "(gone) Z";  // killed, though whoever adopts it may not have reaped it yet
  std::ifstream stat(fmt::format("/proc/{}/stat", orphan));
  std::getline(stat, state);
  EXPECT_TRUE(!stat || contains(state, ") Z")) << state;
}

// --- kernels that give a plausible picture, or used to ---

TEST_F(PluginFault, LightsOnePlaceTooFarAreRefused) {
  expect_refusals(
      {{{"method", "off-by-one"}}}, ErrorKind::refused,
      {"1 of 8 lights of generate.rsm were not written, the first is light 0, and byte 0 past the end of "
       "lights.rsm (416 bytes) was written"});
}

// lavapipe cuts the loop off and goes on with what there is; on a GPU the device is lost.
TEST_F(PluginFault, LightsBehindAnEndlessLoopAreRefused) {
  expect_refusals({{{"method", "endless-loop"}}}, ErrorKind::plugin,
                  {"endless_loop.comp: a loop does not end"});
}

TEST_F(PluginFault, APushBlockOfAnotherSizeIsRefused) {
  expect_refusals(
      {{{"method", "push-block"}}, {{"method", "push-block"}, {"block", "smaller"}}}, ErrorKind::plugin,
      {"push_block.comp: its push-constant block has 12 bytes, and the host pushes 8; make both the same",
       "push_block.comp: its push-constant block has 4 bytes, and the host pushes 8; make both the same"});
}

TEST_F(PluginFault, LightsOfMoreThanTheMethodStatesAreRefused) {
  config_["N"] = 256;  // of 256 texels
  expect_refusals(
      {{{"method", "too-bright"}}}, ErrorKind::refused,
      {"× the texels' power (geometric mean of 1 seeds), and it states at most 1.05 in the mean"});
}

// Only generation can be measured in a black scene: there is no picture to score.
TEST_F(PluginFault, PowerFromNothingIsRefused) {
  Json gltf = box_gltf();
  gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 0, 1};
  gltf["materials"][0]["extensions"] = {{"KHR_materials_specular", {{"specularFactor", 0}}}};
  config_["scenes"] = {write_scene("black", square_scene(), gltf.dump())};
  config_["measure"] = "generation";
  for (const char* key : {"seeds", "reference"}) config_.erase(key);
  config_["methods"] = {{{"method", "vpl"}}, {{"method", "from-nothing"}}};
  RunOptions options{.config = write_config(), .out = out_, .argv = {"vsglbench", "run"}};
  run_config(options);
  const Report r = read_report(out_ / "report.json");
  EXPECT_EQ(r.cases.at(0).status, Status::ok) << r.cases[0].error->message;
  EXPECT_FALSE(r.cases[0].generate->flux) << "undefined where the texels reflect nothing";
  ASSERT_EQ(r.cases.at(1).status, Status::failed);
  EXPECT_EQ(r.cases[1].error->kind, ErrorKind::refused);
  EXPECT_TRUE(contains(r.cases[1].error->message, "power from nothing: the lights carry "));
}

TEST_F(PluginFault, WhatIsNoMethodIsRefusedByItsCase) {
  expect_failures({"bad-pass", "nested-pass", "no-kind", "no-lights", "no-method"}, ErrorKind::plugin,
                  {"pass 'Build Tree': use lower-case letters, digits, '_' and '-', at most 64",
                   "pass 'inner': passes don't nest", "kind() is 7", "light_count(8, 256) is 0",
                   "`create` made no method"});
}

TEST_F(PluginFault, AResultThatNoReportTakesFailsAlone) {
  expect_failures({"raw-pass"}, ErrorKind::internal, {"no report takes its result"});
}

TEST_F(PluginFault, AnEndlessErrorIsCutToALine) {
  expect_failures({"long-error"}, ErrorKind::internal, {"told  [31mand so on and so on"});
  EXPECT_TRUE(contains(read_report(out_ / "report.json").cases[1].error->message, "…"));
}

TEST_F(PluginFault, AnotherWorkingFolderLosesNoImage) {
  EXPECT_EQ(run({"folder"}, fs::relative(out_)).exit_code, 0);
  for (const auto& c : read_report(out_ / "report.json").cases) {
    EXPECT_EQ(c.status, Status::ok);
    for (const auto& [name, image] : c.images) EXPECT_TRUE(fs::exists(out_ / image)) << image;
    EXPECT_FALSE(c.images.empty());
  }
}

TEST_F(PluginFault, AWorkerKilledBeforeItBeganIsStartedOnceMore) {
  const Config config = load_config(write_config());
  WorkerOptions options{.scenes = {data_root() / "scenes", {}}, .out = out_};
  const fs::path starts = folder_ / "starts";
  const auto attempt = [&](size_t killed) {
    write_text(starts, "");
    options.detach = [=] {
      const std::string before = read_text(starts);
      write_text(starts, before + ".");
      if (before.size() < killed) ::raise(SIGKILL);
    };
    SceneOutcome outcome;
    WorkerLog log;
    run_scene_in_workers(
        "cornell", config, config.cases, false, options, [](const Json&) {}, &outcome, &log);
    return outcome.cases.at(0);
  };
  EXPECT_EQ(attempt(1).status, Status::ok);
  EXPECT_EQ(read_text(starts), "..");
  const CaseResult failed = attempt(9);
  EXPECT_EQ(failed.status, Status::failed);
  EXPECT_TRUE(contains(failed.error->message, "signal 9"));
  EXPECT_EQ(read_text(starts), "..");
}

// --- what a plugin says of itself ---

TEST_F(PluginFault, NumbersThatJsonDoesNotKnowAreRefused) {
  EXPECT_EQ(refused("none"), "");
  EXPECT_TRUE(contains(refused("maximum"), "has a parameter 'size' within 0 … inf; both must be finite"));
  EXPECT_TRUE(contains(refused("minimum"), "has a parameter 'size' within nan … 2; both must be finite"));
  EXPECT_TRUE(contains(refused("flux_bound"), "has a flux_bound of nan"));
  EXPECT_TRUE(contains(refused("garbage"), "sent what is no message while it was loaded"));
}

TEST_F(PluginFault, WithoutItsKernelsItIsRefused) {
  fs::copy_file(kBad / "faulty.so", folder_ / "faulty-old.so");
  const std::string why = inspect_plugin(folder_ / "faulty-old.so").refused;
  EXPECT_TRUE(contains(why, "its folder of kernels faulty-old/ is missing; copy it too"));
}

TEST_F(PluginFault, AFileNameThatIsNoTextIsRefused) {
  for (const char* name : {"new\nline.so", "no\xff utf8.so"}) {
    fs::copy_file(kBad / "faulty.so", folder_ / name);
    const std::string why = inspect_plugin(folder_ / name).refused;
    EXPECT_TRUE(contains(why, "its name holds bytes that are no text"));
    EXPECT_NO_THROW(Json(why).dump());
    EXPECT_EQ(why.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace vsglbench
