// `vsglbench figure` as a user meets it.
#include <gtest/gtest.h>

#include <filesystem>

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
  EXPECT_TRUE(read_text(folder_ / "sgl22-1.csv").starts_with("kernel,origin,smape_percent"));
  EXPECT_NE(f.out.find("[SGL22] Fig. 1 holds"), std::string::npos) << f.out;
  const Json report = JsonDocument::load(folder_ / "sgl22-1.json", ErrorKind::output).root();
  EXPECT_EQ(report["config"]["width"], 48);
  EXPECT_EQ(report["claims"].size(), 1u);
}

TEST_F(FigureCommand, RefusesOnOneLine) {
  expect_refused({"figure", "sgl22-5"}, "sgl22-");
  expect_refused({"figure", "quick"}, "describes no figure: it has no key \"figure\"");
  expect_refused({"figure", "sgl22-2", "--width", "100"}, "--width means nothing to sgl22-2");
  expect_refused({"figure", file(R"({"figure": "sgl22-7"})")},
                 "'figure' names no figure: \"sgl22-7\"; did you mean");
  expect_refused({"figure", file(R"({"figure": "sgl22-2", "steps": 10, "step": 10})")}, "did you mean");
  expect_refused({"figure", file(R"({"figure": "sgl22-2", "steps": 1})")}, "figure.json:1");
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
