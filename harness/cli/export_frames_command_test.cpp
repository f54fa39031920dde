// `vsglbench export-frames` on a made report and frames.
#include "cli/cli_fixture.h"
#include "image/exr.h"
#include "report/synthetic_report.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class ExportFramesCommand : public CliTest {
 protected:
  // A case with frames, whose name steers a terminal, and one without.
  void SetUp() override {
    CliTest::SetUp();
    Report report = synthetic_report();
    CaseResult moving = synthetic_case("cornell/mfis/\x1b[31m"), still = synthetic_case("cornell/still");
    moving.images["frames"] = "x.frames";
    moving.images["reference_frames"] = "r.frames";
    still.temporal.reset();
    report.cases = {moving, still};
    report.aa.clear();
    report.analysis = Json();
    write_report(folder_ / "report.json", report);
    for (const char* folder : {"x.frames", "r.frames"})
      for (int frame = 0; frame < 4; ++frame) {
        ExrLayers layers{2, 2, {{"", Image(2, 2, glm::vec3(0.5f))}}, {}, {{"frames_per_second", "8"}}};
        layers.scalars["A"] = std::vector<float>(4, 1);
        write_exr(folder_ / folder / fmt::format("{:04}.exr", frame), layers);
      }
  }
  Finished export_frames(std::vector<std::string> more) const {
    std::vector<std::string> all = {"export-frames", (folder_ / "report.json").string()};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  std::string out() const { return out_.string(); }
};

TEST_F(ExportFramesCommand, PassesOverCasesWithoutFrames) {
  for (const char* glob : {"*", "cornell/*"}) {
    const Finished f = export_frames({"--out", out(), "--only", glob});
    EXPECT_EQ(f.code, 0) << f.err;
    EXPECT_TRUE(contains(f.out, "4 frames at 8 a second"));
    EXPECT_EQ(f.out.find("cornell/still"), std::string::npos) << f.out;
  }
  expect_refused(export_frames({"--out", out(), "--only", "*/still"}), 2, "no case with frames matches");
}

TEST_F(ExportFramesCommand, NothingThatItPrintsSteersTheTerminalOrTheShell) {
  const Finished f = export_frames({"--out", out() + "/a\x1b", "--display", "x; \x1b[31m"});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_EQ(f.out.find('\x1b'), std::string::npos) << f.out;
  EXPECT_TRUE(contains(f.out, "--display 'x; \\x1b[31m'\n"));
}

TEST_F(ExportFramesCommand, WhatCantBeWrittenIsALine) {
  expect_refused(export_frames({"--out", ""}), 2, "needs a folder");
  write("file", "");
  expect_refused(export_frames({"--out", (folder_ / "file").string()}), 2, "can't be made");
}

}  // namespace
}  // namespace vsglbench
