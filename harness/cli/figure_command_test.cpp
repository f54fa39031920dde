// `vsglbench figure` as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/file.h"
#include "base/json.h"
#include "cli/process.h"

namespace vsglbench {
namespace {

class FigureCommand : public ::testing::Test {
 protected:
  FigureCommand() {
    folder_ = std::filesystem::path(testing::TempDir()) / ("vsglbench-figure-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~FigureCommand() override { std::filesystem::remove_all(folder_); }

  void expect_refused(const std::vector<std::string>& arguments, const std::string& part) const {
    const Finished f = finish(start(arguments));
    EXPECT_EQ(f.code, 2) << f.err;
    ASSERT_EQ(f.errors().size(), 1u) << f.err;
    EXPECT_NE(f.err.find(part), std::string::npos) << f.err;
    EXPECT_EQ(f.out, "");
  }
  // Drawn by `method` of the bad plugins: ends by itself with exit code 1 and one line that says which figure
  // and method, and `part`; nothing is written.
  void expect_failed_method(const std::string& method, const std::string& part) const {
    const auto out = folder_ / ("out-" + method);
    const Finished f =
        finish(start({"--plugin-path", bad_plugins().string(), "figure",
                      file(lights_config(method, 4).dump()), "--out", out.string(), "--time-limit", "4"}));
    EXPECT_EQ(f.signal, 0);
    EXPECT_EQ(f.code, 1) << f.err;
    ASSERT_EQ(f.errors().size(), 1u) << f.err;
    EXPECT_NE(f.err.find("figure sgl22-4, method " + method + ": "), std::string::npos) << f.err;
    EXPECT_NE(f.err.find(part), std::string::npos) << f.err;
    EXPECT_TRUE(std::filesystem::is_empty(out));
  }
  static Json lights_config(const std::string& method, std::optional<int> lights) {
    Json c = {{"figure", "sgl22-4"}, {"scene", "cornell"}, {"method", method}, {"rsm", 16},
              {"width", 16},         {"height", 9},        {"repetitions", 3}};
    c["image"] = {{"width", 8}, {"height", 9}};
    c["splotch"] = {{"share", 0.01}, {"least", 0.001}};
    if (lights) c["N"] = *lights;
    return c;
  }
  // `config` with `key` as `value` is refused with file, line and `part`.
  void expect_refused_key(Json config, const std::string& key, const Json& value,
                          const std::string& part) const {
    config[key] = value;
    const auto out = folder_ / "refused";
    const std::string path = file(config.dump(1));  // a line a key
    std::string text = config.dump(1);
    text.resize(text.find("\"" + key + "\""));
    const auto line = 1 + std::ranges::count(text, '\n');
    expect_refused({"figure", path, "--out", out.string()},
                   path + ":" + std::to_string(line) + ": '" + key + "' " + part);
    EXPECT_FALSE(std::filesystem::exists(out));
  }
  std::string file(const std::string& json) const {
    write_text(folder_ / "figure.json", json);
    return (folder_ / "figure.json").string();
  }

  std::filesystem::path folder_;
};

}  // namespace

TEST_F(FigureCommand, WritesTablePlotPictureAndWhereTheyAreFrom) {
  const Finished f =
      finish(start({"figure", "sgl22-1", "--width", "48", "--height", "27", "--out", folder_.string()}));
  ASSERT_EQ(f.code, 0) << f.err;
  for (const char* name : {"sgl22-1.csv", "sgl22-1.svg", "sgl22-1.png", "sgl22-1.json"}) {
    EXPECT_NE(f.out.find((folder_ / name).string()), std::string::npos) << f.out;
    EXPECT_GT(std::filesystem::file_size(folder_ / name), 100u) << name;
  }
  EXPECT_TRUE(read_text(folder_ / "sgl22-1.csv").starts_with("model,origin,smape_percent"));
  EXPECT_NE(f.out.find("[SGL22] Fig. 1 holds"), std::string::npos) << f.out;
  const Json report = JsonDocument::load(folder_ / "sgl22-1.json", ErrorKind::output).root();
  EXPECT_EQ(report["config"]["width"], 48);
  EXPECT_EQ(report["claims"].size(), 1u);
}

TEST_F(FigureCommand, RefusesOnOneLine) {
  expect_refused({"figure", "sgl22-5"}, "sgl22-");
  expect_refused({"figure", "quick"}, "describes no figure: it has no key \"figure\"");
  expect_refused({"figure", file(R"({"figure": "sgl22-7"})")},
                 "'figure' names no figure: \"sgl22-7\"; did you mean");
  expect_refused({"figure", file(R"({"figure": "sgl22-2", "steps": 10, "step": 10})")}, "did you mean");
  expect_refused({"figure", file(R"({"figure": "sgl22-2", "steps": 1})")}, "figure.json:1");
}

TEST_F(FigureCommand, ABadMethodCostsItsFigureAndSaysWhich) {
  expect_failed_method("crashes", "crashed (signal 11, Segmentation fault) during ");
  expect_failed_method("hangs", "was stopped after 4 s without a sign of life during ");
  expect_failed_method("loses-device", "the device was lost");
  expect_failed_method("returns-nan", "not finite: ");
  expect_failed_method("faulty", "its lights light nothing that the camera sees");
}

TEST_F(FigureCommand, RefusesAKeyByFileAndLineBeforeItWrites) {
  const Json hemisphere = {{"figure", "sgl22-3"}, {"least", 1}, {"most", 100}, {"steps", 4}, {"cosines", 11}};
  expect_refused_key(hemisphere, "least", 100, "100 is not under 'most', 100");
  expect_refused_key(hemisphere, "least", 101, "101 is not under");
  const Json lights = lights_config("mfis", 4);
  expect_refused_key(lights, "scene", "cornel", "no scene 'cornel'; did you mean 'cornell'?");
  expect_refused_key(lights, "scene", "cornell:nowhere", "cornell has no view 'nowhere'");
  expect_refused_key(lights, "method", "mfiss", "no method 'mfiss'; did you mean 'mfis'?");
  expect_refused_key(lights, "method", "vpl", "vpl makes no VSGLs");
  expect_refused_key(lights, "parameters", {{"width", 1}}, "");
  expect_refused_key(lights, "N", 257, "257 lights can't be drawn from an RSM of 256 texels");
  expect_refused_key(lights_config("two-vsgl", {}), "N", 2, "is not read: two-vsgl makes 2 lights");
  expect_refused({"figure", file(lights_config("mfis", {}).dump())}, "lacks 'N'");
}

TEST_F(FigureCommand, RefusesASizeBeyondTheConfigsLimits) {
  expect_refused({"figure", "sgl22-1", "--width", "4097"},
                 "--width 4097 is too large for sgl22-1; make it at most 4096");
  expect_refused({"figure", "sgl22-4", "--height", "2161"}, "make it at most 2160");
  expect_refused({"figure", "sgl22-2", "--width", "100"},
                 "--width 100 is too small for sgl22-2; make it at least 800");
}

// Without N, since two-vsgl reads none. The SMAPE is of a smaller image than the rest, and says so.
TEST_F(FigureCommand, EveryNumberStandsBesideItsSize) {
  const Finished f =
      finish(start({"figure", file(lights_config("two-vsgl", {}).dump()), "--out", folder_.string()}));
  ASSERT_EQ(f.code, 0) << f.err;
  const std::string csv = read_text(folder_ / "sgl22-4.csv");
  EXPECT_NE(csv.find(",repetitions,black_pixels,image_width,image_height,smape_percent\n"), csv.npos);
  EXPECT_NE(csv.find("\ncosine,measured,16,9,"), csv.npos);
  EXPECT_NE(csv.find(",8,9,"), csv.npos);
  const Json report = JsonDocument::load(folder_ / "sgl22-4.json", ErrorKind::output).root();
  ASSERT_EQ(report["claims"].size(), 5u);
  for (const Json& claim : report["claims"])
    EXPECT_TRUE(claim["holds"].is_boolean() || claim["holds"].is_null()) << claim;
}

// The other way round: an experiment is not a figure.
TEST_F(FigureCommand, RunRefersToFigure) {
  expect_refused({"run", "sgl22-1"}, "describes a figure; draw it with `vsglbench figure sgl22-1`");
  const Finished f = finish(start({"list", "configs"}));
  EXPECT_EQ(f.code, 0);
  EXPECT_NE(f.out.find("sgl22-4"), std::string::npos);
  EXPECT_EQ(f.out.find("broken"), std::string::npos) << f.out;
}

}  // namespace vsglbench
