// The programme as a user meets it: exit codes, messages, and what stays on the disk.
#include <chrono>
#include <csignal>
#include <thread>

#include "cli/cli_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

TEST_F(CliTest, EveryCommandHasHelpWithAnExample) {
  for (const char* command :
       {"run", "list", "reference", "doctor", "new-method", "check-method", "code-size", "blocks", "table"}) {
    const Finished f = run({command, "--help"});
    EXPECT_EQ(f.code, 0);
    EXPECT_TRUE(contains(f.out, "Example"));
    EXPECT_TRUE(contains(f.out, fmt::format(": vsglbench {}", command)));
  }
  const Finished f = run({"--help"});
  EXPECT_EQ(f.code, 0);
  EXPECT_TRUE(contains(f.out, "Exit codes: 0"));
  EXPECT_TRUE(contains(f.out, "4 'compare' found a regression, 5 'compare' refuses"));
}

TEST_F(CliTest, BadUsageIsOneLineAndExitCode2) {
  expect_refused(run({}), 2, "subcommand is required");
  EXPECT_FALSE(contains(run({"kernls"}).err, "'kernels'"));  // a name of old, which is not shown
  expect_refused(run({"rnu", "x"}), 2, "no command 'rnu'; did you mean 'run'?");
  expect_refused(run({"run"}), 2, "no experiment: give a config");
  expect_refused(run({"run", "quick", "--out", "o\xff"}), 2, "argument 4 is not UTF-8");
  expect_refused(run({"run", "quick", "--ouput", "x"}), 2, "--ouput");
  expect_refused(run({"run", "quik"}), 2, "no config 'quik'; did you mean 'quick'?");
  expect_refused(run({"list", "everything"}), 2, "everything");
  expect_refused(run({"reference", "cornell", "--width", "0"}), 2, "width");
  expect_refused(run({"reference", "cornel"}), 2, "did you mean 'cornell'?");
}

TEST_F(CliTest, WhatIsNotAConfig) {
  expect_refused(run({"run", folder_.string() + "/"}), 2, "is a folder");
  expect_refused(run({"run", write("empty.json", "").string()}), 2, "empty.json:1: not JSON");
  expect_refused(run({"run", write("garbage.json", std::string("\x7f"
                                                               "ELF\0\1\2\xff",
                                                               8))
                                 .string()}),
                 2, "not JSON");
  config_["frame"]["width"] = 0;
  expect_refused(run_config(), 2, "must be at least 1");
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(CliTest, ListsAreTextOrJson) {
  for (const char* what : {"methods", "scenes", "configs", "devices"}) {
    const Finished text = run({"list", what}), json = run({"list", what, "--json"});
    EXPECT_EQ(text.code, 0);
    ASSERT_EQ(json.code, 0);
    const Json rows = Json::parse(json.out);
    ASSERT_FALSE(rows.empty()) << what;
    for (const auto& row : rows) EXPECT_TRUE(contains(text.out, row.at("name").get<std::string>()));
  }
}

TEST_F(CliTest, BlocksTimesABlockAndWritesItDown) {
  const std::string file = (folder_ / "blocks.json").string();
  const Finished f =
      run({"blocks", "sort", "-q", "--sizes", "1000", "3000", "--repetitions", "2", "--out", file});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "std::sort"));
  EXPECT_TRUE(contains(f.out, "grows as size^"));
  const Json report = Json::parse(read_text(file));
  EXPECT_EQ(report.at("schema"), "vsglbench.blocks/1");
  EXPECT_FALSE(report.at("blocks").at(0).at("times").empty());
  expect_refused(run({"blocks", "bubble"}), 2, "bubble");
  expect_refused(run({"kernels", "bubble"}), 2, "bubble");  // the old name
  expect_refused(run({"blocks", "sort", "--sizes", "0"}), 2, "sizes");
  expect_refused(run({"blocks", "sort", "-q", "--out", folder_.string()}), 2, "is a folder");
}

TEST_F(CliTest, CodeSizeHasARowForEachMethod) {
  const Finished f = run({"code-size"}), json = run({"code-size", "--json"});
  EXPECT_EQ(f.code, 0) << f.err;
  for (const char* method : {"all-texels", "vpl", "fis", "mfis", "kmeans2d", "kmeans3d-segmented"}) {
    EXPECT_TRUE(contains(f.out, method));
  }
  EXPECT_TRUE(contains(f.out, "9, 39, 1172"));
  for (const auto& row : Json::parse(json.out)) {
    EXPECT_GT(row.at("own_lines"), 0);
    EXPECT_GT(row.at("dispatches").at("rsm"), 0);
  }
}

TEST_F(CliTest, DoctorFindsADevice) {
  const Finished f = run({"doctor"});
  EXPECT_EQ(f.code, 0) << f.err;
  for (const char* part : {"host", "device 0", "usable", "data", "cache", "ready"})
    EXPECT_TRUE(contains(f.out, part));
}

TEST_F(CliTest, NoDriverIsExitCode3) {
  for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"})
    ::setenv(name, (folder_ / "absent.json").c_str(), 1);
  const Finished doctor = run({"doctor"}), bench = run_config();
  for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) ::unsetenv(name);
  expect_refused(doctor, 3, "no usable device");
  EXPECT_TRUE(contains(doctor.out, "device      none"));
  expect_refused(bench, 3, "no Vulkan");
}

TEST_F(CliTest, AnUnknownDeviceIsExitCode3) {
  expect_refused(run({"run", write_config().string(), "--out", out_.string(), "--device", "nonesuch"}), 3,
                 "no device 'nonesuch'; known: 0: ");
  expect_refused(run({"run", write_config().string(), "--out", out_.string(), "--device", "77"}), 3,
                 "no device '77'");
}

TEST_F(CliTest, ReferenceWritesItsImages) {
  const Finished f = run(
      {"reference", "cornell", "--width", "32", "--height", "18", "--samples", "4", "--out", out_.string()});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "30 triangles"));
  EXPECT_TRUE(fs::exists(out_ / "cornell.reference.exr"));
  EXPECT_TRUE(fs::exists(out_ / "cornell.reference.png"));
}

TEST_F(CliTest, ARunPrintsItsTable) {
  const Finished f = run_config();
  EXPECT_EQ(f.code, 0);
  for (const char* part : {"\ncornell\n  vpl ", "noise floor", "every case: N=16,rsm=16,vis=exact"})
    EXPECT_TRUE(contains(f.out, part));
  EXPECT_TRUE(f.err.empty()) << f.err;  // no progress bar where there is no terminal
}

TEST_F(CliTest, TheValidationLayersAreSilent) {
  config_["methods"] = {{{"method", "vpl"}}, {{"method", "mfis"}}};
  const Finished f = run({"-q", "run", write_config().string(), "--out", out_.string(), "--validate"});
  EXPECT_EQ(f.code, 0) << f.err;
}

class Interrupted : public CliTest {
 protected:
  // Starts a run of two scenes and ends it with `signal` once the first is saved.
  Finished interrupt(int signal) {
    config_["scenes"] = {"cornell", "ring514"};
    config_["timing"] = {{"min_samples", 60}, {"max_samples", 60}};
    const RunningProgramme child = start({"-q", "run", write_config().string(), "--out", out_.string()});
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!fs::exists(out_ / "report.json") && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::kill(child.pid, signal);
    return finish(child);
  }
  void expect_goes_on() {
    const Report stopped = report();
    EXPECT_FALSE(stopped.complete);
    ASSERT_EQ(stopped.cases.size(), 1u);
    EXPECT_EQ(run_config().code, 0);
    const Report resumed = report();
    EXPECT_TRUE(resumed.complete);
    ASSERT_EQ(resumed.cases.size(), 2u);
    EXPECT_EQ(resumed.cases[0].frame->span.samples, stopped.cases[0].frame->span.samples);
    EXPECT_EQ(resumed.cases[1].scene, "ring514");
    expect_sound(out_ / "report.json");
  }
};

TEST_F(Interrupted, ByKill) {
  EXPECT_EQ(interrupt(SIGKILL).signal, SIGKILL);
  expect_goes_on();
}

TEST_F(Interrupted, ByCtrlC) {
  const Finished f = interrupt(SIGINT);
  EXPECT_EQ(f.signal, SIGINT);
  ASSERT_EQ(f.errors().size(), 1u) << f.err;
  EXPECT_TRUE(contains(f.errors()[0], "interrupted; the same command goes on"));
  expect_goes_on();
}

}  // namespace
}  // namespace vsglbench
