// Plugins as a user meets them: the bad ones cost their own case, and a new one is made outside the tree.
#include <algorithm>
#include <cstdlib>

#include "cli/cli_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class PluginTest : public CliTest {
 protected:
  void use_methods(const std::vector<std::string>& names) {
    config_["methods"] = Json::array();
    for (const auto& name : names) config_["methods"].push_back({{"method", name}});
  }
  static const CaseResult& of(const Report& report, const std::string& method) {
    const auto same = [&](const CaseResult& c) { return c.method == method; };
    const auto found = std::find_if(report.cases.begin(), report.cases.end(), same);
    if (found == report.cases.end()) throw std::runtime_error("no case of " + method);
    return *found;
  }
  static void expect_failed(const CaseResult& c, ErrorKind kind, const std::string& part) {
    EXPECT_EQ(c.status, Status::failed) << c.id;
    ASSERT_TRUE(c.error) << c.id;
    EXPECT_EQ(name(c.error->kind), name(kind)) << c.error->message;
    EXPECT_TRUE(contains(c.error->message, part));
  }
  // Runs a programme that is not vsglbench; its output.
  static std::string shell(const std::string& command) {
    const std::string all = command + " 2>&1";
    FILE* pipe = ::popen(all.c_str(), "r");
    std::string out;
    char part[4096];
    for (size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) out.append(part, n);
    EXPECT_EQ(::pclose(pipe), 0) << command << "\n" << out;
    return out;
  }
  const fs::path bad_ = bad_plugins();
};

TEST_F(PluginTest, PricingEffectsByABadOneEndsInALine) {
  const auto price = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = {
        "--plugin-path", bad_.string(), "effects",  "cornell", "--price", "--rounds", "1",
        "--width",       "16",          "--height", "16",      "--rsm",   "16"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  expect_refused(price({"--method", "crashes"}), 1, "crashes while a frame with the effects");
  expect_refused(price({"--method", "hangs", "--time-limit", "2"}), 1, "without a sign of life");
  expect_refused(price({"--lights", "0"}), 2, "--lights");
  expect_refused(price({"--method", "no-such"}), 2, "no-such");
  EXPECT_EQ(price({}).code, 0);
}

// An object's name is a file's, and the terminal is not its to steer.
TEST_F(PluginTest, TheLedgerShowsNoNameRaw) {
  const fs::path scene = folder_ / "named" / "scene.json";
  fs::create_directories(scene.parent_path());
  write_text(scene, R"({"name": "named", "description": "a ring whose name is an escape sequence",
    "geometry": {"builder": "cornell"}, "animation": {"frames": 2, "rate": 1},
    "objects": [{"name": "\u001b[31mred\u0007", "torus": {"major": 0.2, "minor": 0.05}, "interpolation": "linear",
      "keys": [{"time": 0, "translation": [0, 1, 0]}, {"time": 1, "translation": [0.1, 1, 0]}]}],
    "views": {"A": {"camera": {"eye": [0, 1, 3], "direction": [0, 0, -1], "vfov": 50},
      "light": {"spot": {"position": [0.3, 1.9, 0.4], "target": [0, 0, 0], "fov": 70, "intensity": 10}}}},
    "default_view": "A"})");
  const Finished shown = run({"effects", scene.string()});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_TRUE(contains(shown.out, "[31mred"));
  EXPECT_EQ(shown.out.find_first_of("\x1b\x07"), std::string::npos) << shown.out;
}

TEST_F(PluginTest, ABadOneCostsItsOwnCaseAndNothingElse) {
  use_methods({"vpl", "wrong-abi", "crashes", "crashes-on-load", "hangs", "loses-device", "needs-feature",
               "returns-nan", "mfis"});
  config_["N"] = 8;
  const Finished f = run({"-q", "--plugin-path", bad_.string(), "run", write_config().string(), "--out",
                          out_.string(), "--time-limit", "4"});
  EXPECT_EQ(f.signal, 0);
  EXPECT_EQ(f.code, 1) << f.err;
  expect_sound(out_ / "report.json");
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 9u);
  for (const char* sound : {"vpl", "mfis"}) {
    EXPECT_EQ(of(r, sound).status, Status::ok);
    EXPECT_TRUE(of(r, sound).accuracy);
    EXPECT_EQ(of(r, sound).seeds.size(), 2u);
  }
  expect_failed(of(r, "wrong-abi"), ErrorKind::plugin, "was built for plugin ABI");
  expect_failed(of(r, "crashes-on-load"), ErrorKind::plugin,
                "crashed (signal 6, Aborted) while it was loaded");
  expect_failed(of(r, "needs-feature"), ErrorKind::plugin, "needs shaderTelepathy, which");
  expect_failed(of(r, "crashes"), ErrorKind::crashed, "signal 11");
  expect_failed(of(r, "hangs"), ErrorKind::timeout, "4 s");
  expect_failed(of(r, "loses-device"), ErrorKind::device_lost, "the device was lost");
  expect_failed(of(r, "returns-nan"), ErrorKind::not_finite, "generate.gbuffer");
}

// Each used to give status ok and a plausible SMAPE.
TEST_F(PluginTest, KernelsThatAreWrongInSilenceAreRefused) {
  use_methods({"off-by-one", "endless-loop", "push-block", "mfis"});
  const Finished f =
      run({"-q", "--plugin-path", bad_.string(), "run", write_config().string(), "--out", out_.string()});
  EXPECT_EQ(f.code, 1) << f.err;
  const Report r = report();
  EXPECT_EQ(of(r, "mfis").status, Status::ok);
  expect_failed(of(r, "off-by-one"), ErrorKind::refused,
                "the first is light 0, and byte 0 past the end of lights.rsm");
  expect_failed(of(r, "endless-loop"), ErrorKind::plugin, "endless_loop.comp: a loop does not end");
  expect_failed(of(r, "push-block"), ErrorKind::plugin, "block has 12 bytes, and the host pushes 8");
}

// The texel whose weight is a NaN is (5, 3) of the RSM; lights and image are sound.
TEST_F(PluginTest, CheckPassesNamesThePassAndTexelThatWentBad) {
  use_methods({"vpl", "hides-nan", "mfis", "kmeans3d"});
  config_["N"] = 8;
  const std::vector<std::string> ordinary = {
      "-q", "--plugin-path", bad_.string(), "run", write_config().string(), "--out", out_.string()};
  EXPECT_EQ(run(ordinary).code, 0);
  EXPECT_FALSE(report().config.contains("check_passes"));
  EXPECT_EQ(report().aa.size(), 1u);
  auto checked = ordinary;
  checked.push_back("--check-passes");
  const Finished f = run(checked);
  EXPECT_EQ(f.code, 1) << f.err;
  EXPECT_TRUE(contains(f.err, "times are not comparable"));
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_EQ(r.config.at("check_passes"), true);
  EXPECT_TRUE(r.aa.empty());  // of times
  for (const char* sound : {"vpl", "mfis", "kmeans3d"}) EXPECT_EQ(of(r, sound).status, Status::ok);
  const CaseResult& bad = of(r, "hides-nan");
  expect_failed(
      bad, ErrorKind::not_finite,
      "pass generate.rsm.weigh is the first to hold a NaN: buffer weights, element 53, texel (5, 3)");
  ASSERT_TRUE(bad.health && bad.health->first_bad);
  EXPECT_EQ(bad.health->nan, 1u);
  EXPECT_EQ(bad.health->inf, 0u);
  EXPECT_EQ(bad.health->first_bad->pass, "generate.rsm.weigh");
  EXPECT_EQ(bad.health->first_bad->buffer, "weights");
  EXPECT_EQ(bad.health->first_bad->element, 53u);
  EXPECT_EQ(bad.health->first_bad->texel, glm::uvec2(5, 3));
  EXPECT_FALSE(bad.health->first_bad->pixel || bad.health->first_bad->light);
}

TEST_F(PluginTest, ListShowsWhatWasRefusedAndWhy) {
  const Finished f = run({"--plugin-path", bad_.string(), "list", "methods"});
  EXPECT_EQ(f.code, 0);
  EXPECT_TRUE(contains(f.out, "refused: plugin"));
  EXPECT_TRUE(contains(f.out, "was built for plugin ABI"));
  EXPECT_TRUE(contains(f.out, "mfis"));
  expect_refused(run({"--plugin-path", "/nowhere", "list", "methods"}), 2, "no such folder");
  write("junk/junk.so", "not a library");
  const Finished junk = run({"list", "methods", "--plugin-path", (folder_ / "junk").string()});
  EXPECT_EQ(junk.code, 0);
  EXPECT_TRUE(contains(junk.out, "junk.so: can't be loaded"));
}

TEST_F(PluginTest, NewMethodRefusesWhatItCantWrite) {
  expect_refused(run({"new-method", "mfis", "--dir", folder_.string()}), 2, "exists already");
  expect_refused(run({"new-method", "My Method", "--dir", folder_.string()}), 2, "can't name a method");
  expect_refused(run({"new-method", "mine", "--dir", "/proc"}), 2, "/proc/mine");
  expect_refused(run({"new-method", "mine", "--dir", "a\"b"}), 2, "quotation mark");
  expect_refused(run({"new-method", "mine", "--dir", "a\nb"}), 2, "control character");
  expect_refused(run({"check-method", folder_.string()}), 2, "is a folder");
  EXPECT_EQ(run({"new-method", "mine", "--dir", folder_.string()}).code, 0);
  expect_refused(run({"new-method", "mine", "--dir", folder_.string()}), 2, "exists already");
}

// From an installed vsglbench alone: write a method of each template, build it, test it, list it, run it.
TEST_F(PluginTest, ANewMethodIsBuiltOutsideTheTreeAndRuns) {
  if (tests_are_installed()) GTEST_SKIP() << "only a build folder can be installed";
  const fs::path prefix = folder_ / "prefix";
  shell(fmt::format("cmake --install {} --prefix {}", test_build().string(), prefix.string()));
  const std::string installed = (prefix / "bin" / "vsglbench").string();
  std::string plugins;
  for (const std::string kind : {"thread", "workgroup"}) {
    const fs::path method = folder_ / ("my_" + kind);
    shell(fmt::format("{} new-method my-{} --dir {} --template {}", installed, kind, folder_.string(), kind));
    const std::string configured = shell(fmt::format(
        "cmake -S {0} -B {0}/build -G Ninja -DCMAKE_PREFIX_PATH={1}", method.string(), prefix.string()));
    EXPECT_EQ(configured.find("Warning"), std::string::npos) << configured;
    shell(fmt::format("cmake --build {}/build", method.string()));
    shell(fmt::format("ctest --test-dir {}/build --output-on-failure --no-tests=error", method.string()));
    plugins += (plugins.empty() ? "" : ":") + (method / "build" / "plugins").string();
  }
  use_methods({"my-thread", "my-workgroup", "vpl"});
  const fs::path config = write_config();
  shell(fmt::format("VSGLBENCH_PLUGINS={} {} -q run {} --out {}", plugins, installed, config.string(),
                    out_.string()));
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 3u);
  for (const char* method : {"my-thread", "my-workgroup"}) {
    ASSERT_EQ(of(r, method).status, Status::ok) << method;
    // Unbiased: as bright as the VPLs, but for the blur and the noise of 16 lights.
    EXPECT_NEAR(*of(r, method).accuracy->bias.value, *of(r, "vpl").accuracy->bias.value, 0.5) << method;
  }
}

}  // namespace
}  // namespace vsglbench
