// A scene of one's own as a user meets it: --scene, new-scene, view, export.
#include "cli/cli_fixture.h"
#include "image/png.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class SceneCommands : public CliTest {
 protected:
  std::string box() const { return write("box.gltf", box_gltf().dump()).string(); }
  Finished run_on(const std::string& scene, const fs::path& out) {
    return run({"-q", "run", write_config().string(), "--scene", scene, "--out", out.string()});
  }
};

TEST_F(SceneCommands, AModelIsMeasuredAndSoIsItsSceneFile) {
  const Finished made = run({"-q", "new-scene", box(), "--dir", (folder_ / "made").string()});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(contains(made.out, "a view and a spot were found"));
  EXPECT_EQ(read_png(folder_ / "made/preview.png").width, 2u * 640 + 36);
  ASSERT_EQ(run_on(box(), folder_ / "a").code, 0);
  ASSERT_EQ(run_on((folder_ / "made").string(), folder_ / "b").code, 0);
  const Report a = read_report(folder_ / "a/report.json"), b = read_report(folder_ / "b/report.json");
  ASSERT_EQ(a.scenes.size(), 1u);
  EXPECT_EQ(a.scenes[0].name, box());
  EXPECT_EQ(a.scenes[0].hash, b.scenes[0].hash);
  EXPECT_EQ(a.scenes[0].triangles, 6u);
  ASSERT_EQ(a.cases.size(), 1u);
  EXPECT_EQ(a.cases[0].status, Status::ok);
  EXPECT_EQ(a.cases[0].accuracy->reference.hash, b.cases[0].accuracy->reference.hash);
  // Another --dir is not written over.
  expect_refused(run({"new-scene", box(), "--dir", (folder_ / "made").string()}), 2, "is there already");
  expect_refused(run({"new-scene", (folder_ / "made/scene.json").string(), "--dir", "x"}), 2,
                 "is no glTF file");
}

// With --scene, and in place of a config.
TEST_F(SceneCommands, EveryCommandTakesAModel) {
  const std::string config = write_config().string();
  const fs::path lights = folder_ / "lights", references = folder_ / "references";
  const Finished drawn = run({"-q", "lights", config, "--scene", box(), "--out", lights.string()});
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  size_t pictures = 0;
  for (const auto& file : fs::recursive_directory_iterator(lights))
    pictures += file.path().filename() == "scene.png";
  EXPECT_EQ(pictures, 1u);
  const Finished truth = run({"reference", "--scene", box(), "--width", "32", "--height", "18", "--samples",
                              "16", "--out", references.string()});
  EXPECT_EQ(truth.code, 0) << truth.err;
  EXPECT_TRUE(contains(truth.err, "a view and a spot were found"));
  EXPECT_TRUE(contains(truth.out, "6 triangles, 16 samples"));
  EXPECT_TRUE(contains(truth.out, "box.reference.exr"));
  const Finished effects = run({"effects", "--scene", box()});
  EXPECT_EQ(effects.code, 0) << effects.err;
  EXPECT_TRUE(contains(effects.out, "occlusion"));
}

TEST_F(SceneCommands, AModelInPlaceOfAConfigIsTheScene) {
  const Finished f =
      run({"run", box(), "--scale", "small", "--only", "*/vpl/*", "--set", "N=16", "--out", out_.string()});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.err, "is a scene: the methods are those of configs/quick.json"));
  EXPECT_EQ(report().scenes.at(0).triangles, 6u);
}

TEST_F(SceneCommands, WhatIsNoSceneIsRefused) {
  expect_refused(run_on("absent.glb", out_), 2, "--scene 1: no scene 'absent.glb'");
  expect_refused(run_on("cornel", out_), 2, "did you mean 'cornell'?");
  expect_refused(run({"run"}), 2, "give a config, such as configs/quick.json, or --scene model.glb");
  expect_refused(run({"export", "cornell"}), 2, "--to for a scene");
}

TEST_F(SceneCommands, ViewDrawsOneSheet) {
  const Finished f =
      run({"view", box(), "--out", out_.string(), "--width", "64", "--height", "36", "--rsm", "64"});
  ASSERT_EQ(f.code, 0) << f.err;
  std::string path = f.out.substr(0, f.out.find('\n'));
  const Bitmap sheet = read_png(path);
  EXPECT_GT(sheet.width, 1000u);
  EXPECT_GT(sheet.height, 300u);
}

// All that is wrong, a line each.
TEST_F(SceneCommands, AllFaultsOfASceneFileAreLinesOfTheirOwn) {
  Json scene = square_scene("absent.gltf");
  scene["views"]["front"]["camera"]["vfov"] = 0;
  scene["default_view"] = "back";
  const Finished f = run({"effects", write_scene("square", scene, "")});
  EXPECT_EQ(f.code, 2);
  ASSERT_EQ(f.errors().size(), 3u) << f.err;
}

}  // namespace
}  // namespace vsglbench
