// What is wrong with scenes, sizes, methods and disks: one clear line or a failed case; no crash, nothing
// lost.
#include "cli/cli_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// --- geometry and textures ---

TEST_F(CliTest, GeometryThatIsBrokenFailsItsCasesWithOneLine) {
  const Json box = box_gltf();
  const std::string text = box.dump();
  use_scene(square_scene(), "");
  expect_failed_case("square.gltf, which does not exist");
  use_scene(square_scene(), text.substr(0, text.size() / 2));
  expect_failed_case("square.gltf");
  Json bad = box;
  bad["accessors"][1]["bufferView"] = 0;  // bits of floats as indices
  use_scene(square_scene(), bad.dump());
  expect_failed_case("vertices");
  bad = box;
  std::string bytes(132, '\xff');  // every float a NaN
  bad["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bytes);
  use_scene(square_scene(), bad.dump());
  expect_failed_case("square.gltf");
  bad = box;
  bad["images"] = {{{"uri", "data:image/png;base64," + base64("this is no image")}}};
  bad["textures"] = {{{"source", 0}}};
  bad["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  use_scene(square_scene(), bad.dump());
  expect_failed_case("image");
}

TEST_F(CliTest, ABrokenSceneLeavesTheOthers) {
  config_["scenes"] = {write_scene("square", square_scene(), "no glTF"), "cornell"};
  EXPECT_EQ(run_config().code, 1);
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 2u);
  EXPECT_EQ(r.cases[0].status, Status::failed);
  EXPECT_EQ(r.cases[0].error->kind, ErrorKind::scene);
  EXPECT_EQ(r.cases[1].status, Status::ok);
  EXPECT_EQ(r.aa.size(), 1u);
}

TEST_F(CliTest, AMissingAssetIsSkipped) {
  Json scene = square_scene("far/away.gltf");
  scene["get_it"] = "https://example.org/away";
  use_scene(scene, "");
  config_["N"] = {8, 16};
  const Finished f = run_config();
  EXPECT_EQ(f.code, 0) << f.err;
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 2u);
  for (const CaseResult& c : r.cases) EXPECT_EQ(c.status, Status::skipped);
  for (const char* part : {"far/away.gltf", "https://example.org/away", "--assets"}) {
    EXPECT_TRUE(contains(r.cases[1].error->message, part));
    EXPECT_TRUE(contains(f.out, part));
    EXPECT_EQ(f.out.find(part), f.out.rfind(part)) << "told twice: " << f.out;
  }
  EXPECT_TRUE(contains(f.out, "skipped: as said above"));
}

// --- lights and cameras ---

TEST_F(CliTest, ALightThatSeesNothing) {
  Json scene = square_scene();
  scene["views"]["front"]["light"]["spot"]["target"] = {1, 1, 9};
  use_scene(scene, box_gltf().dump());
  expect_failed_case("the light sees no surface");
}

TEST_F(CliTest, ACameraThatSeesNothing) {
  Json scene = square_scene();
  scene["views"]["front"]["camera"]["direction"] = {0, 0, 1};
  use_scene(scene, box_gltf().dump());
  expect_failed_case("the camera sees no surface");
}

TEST_F(CliTest, ACameraInsideAWall) {
  Json scene =
      square_scene();  // on the plane of the wall, looking into it: what it sees is the far side, unlit
  scene["views"]["front"]["camera"] = {{"eye", {0, 0, -0.001}}, {"direction", {0, 0, 1}}, {"vfov", 20}};
  use_scene(scene, box_gltf().dump());
  expect_failed_case("no indirect light reaches the view");
}

// --- sizes ---

TEST_F(CliTest, AbsurdSizesFailWithoutTakingTheMemory) {
  const Limits little{.data_bytes = rlim_t(8) << 30};
  config_["frame"] = {{"width", 16384}, {"height", 16384}};
  expect_failed_case("a frame of 16384 x 16384 with an RSM of 16 x 16 needs about", little);
  config_["frame"] = {{"width", 32}, {"height", 18}};
  config_["rsm"] = 16384;
  expect_failed_case("a frame of 32 x 18 with an RSM of 16384 x 16384 needs about", little);
  config_["rsm"] = 2048;
  config_["methods"] = {{{"method", "all-texels"}}};
  config_["frame"] = {{"width", 4096}, {"height", 4096}};
  expect_failed_case("GiB", little);
  expect_refused(
      run({"reference", "cornell", "--width", "16384", "--height", "16384", "--out", out_.string()}, little),
      1, "a reference of 16384 x 16384 needs about");
}

// --- methods that are broken: a copy of one with a kernel of its own ---

class BrokenKernel : public CliTest {
 protected:
  // Puts `statement` into a copy of vpl's kernel, before it returns its light `v`.
  void edit(const std::string& statement) const {
    const fs::path plugins = folder_ / "plugins", source = data_root() / "methods" / "vpl";
    fs::create_directories(plugins / "vpl");
    fs::copy_file(library_directory() / "vsglbench" / "plugins" / "vpl.so", plugins / "vpl.so",
                  fs::copy_options::overwrite_existing);
    std::string text = read_text(source / "vpl.comp");
    text.insert(text.find("return v;"), statement + "\n");
    write_text(plugins / "vpl" / "vpl.comp", text);
    ::setenv("VSGLBENCH_PLUGINS", plugins.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("VSGLBENCH_PLUGINS");
    CliTest::TearDown();
  }
  void run_both(const std::string& part) {
    config_["methods"] = {{{"method", "vpl"}}, {{"method", "mfis"}}};
    const Finished f = run_config();
    EXPECT_EQ(f.signal, 0);
    EXPECT_EQ(f.code, 1) << f.err;
    expect_sound(out_ / "report.json");
    const Report r = report();
    ASSERT_EQ(r.cases.size(), 2u);
    EXPECT_EQ(r.cases[0].status, Status::failed);
    EXPECT_TRUE(contains(r.cases[0].error->message, part));
    EXPECT_EQ(r.cases[1].status, Status::ok);
    ASSERT_EQ(r.aa.size(), 1u);
    EXPECT_EQ(r.aa[0].case_id, r.cases[1].id);
  }
};

TEST_F(BrokenKernel, ThatDoesNotCompile) {
  edit("this is no GLSL");
  run_both("vpl.comp:");
  EXPECT_EQ(report().cases[0].error->kind, ErrorKind::plugin);
}

TEST_F(BrokenKernel, ThatMakesANaN) {
  edit("if (i == 3u) { v.flux = vec3(uintBitsToFloat(0x7fc00000u)); v.power = 1.0; }");
  config_["visibility"] = "none";
  run_both("NaN");
  const Report r = report();
  EXPECT_EQ(r.cases[0].error->kind, ErrorKind::not_finite);
  EXPECT_GT(r.cases[0].health->nan, 0u);
  EXPECT_FALSE(r.cases[0].health->first_bad->pass.empty());
}

TEST_F(BrokenKernel, ThatPutsALightNowhere) {
  edit("if (i == 3u) v.position = vec3(uintBitsToFloat(0x7f800000u));");
  run_both("light 3 of pass generate.rsm stands at (inf, inf, inf)");
  edit("if (i == 3u) v.position = vec3(1e30);");
  run_both("not a place in the scene");
}

// --- output ---

TEST_F(CliTest, OutputThatCannotBeWritten) {
  const fs::path file = write("file", "mine");
  for (const std::string& out :
       {(file / "below").string(), file.string(), std::string("/proc/vsglbench"), std::string("/dev/full")}) {
    const Finished f = run({"-q", "run", write_config().string(), "--out", out});
    EXPECT_EQ(f.code, 2) << out << f.err;
    EXPECT_EQ(f.errors().size(), 1u) << f.err;
  }
  EXPECT_EQ(read_text(file), "mine");
  fs::create_directories(out_ / "report.json");
  expect_refused(run_config(), 2, "is a folder");
}

// A full disk, as a limit on the size of any file.
TEST_F(CliTest, AFullDiskLosesNoEarlierReport) {
  ASSERT_EQ(run_config().code, 0);
  const std::string before = read_text(out_ / "report.json");
  for (const rlim_t limit : {rlim_t(256), rlim_t(2048), rlim_t(before.size() / 2)}) {
    const Finished f = run_config({.file_bytes = limit});
    EXPECT_EQ(f.signal, 0) << limit;
    EXPECT_EQ(f.code, 2) << limit << f.err;
    ASSERT_EQ(f.errors().size(), 1u) << f.err;
    EXPECT_TRUE(contains(f.errors()[0], "File too large"));
    EXPECT_EQ(read_text(out_ / "report.json"), before) << limit;
    EXPECT_FALSE(fs::exists(out_ / "report.previous.json"));
  }
}

// Room for the report but not for the images: the numbers are kept, the case fails.
TEST_F(CliTest, ImagesThatCannotBeWrittenFailTheCaseAndKeepItsNumbers) {
  write(fs::path("out") / "images", "in the way");
  const Finished f = run_config();
  EXPECT_EQ(f.code, 1) << f.err;
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_EQ(r.cases.at(0).status, Status::failed);
  EXPECT_EQ(r.cases[0].error->kind, ErrorKind::output);
  EXPECT_TRUE(r.cases[0].accuracy.has_value());
  EXPECT_FALSE(r.cases[0].passes.empty());
}

TEST_F(CliTest, OutputThatGoesNowhereIsAnError) {
  const Finished f = finish(start({"list", "methods"}, {.standard_output = "/dev/full"}));
  expect_refused(f, 2, "standard output");
}

TEST_F(CliTest, ACacheThatCannotBeWrittenIsAWarning) {
  ::setenv("VSGLBENCH_CACHE", "/proc/vsglbench", 1);
  const Finished f = run_config();
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.err, "warning: "));
}

}  // namespace
}  // namespace vsglbench
