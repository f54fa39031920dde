// What a file says reaches the terminal as text, cut and harmless; and what any user would expect of a
// number, a name and a black picture.
#include "base/file.h"
#include "cli/cli_fixture.h"
#include "image/exr.h"
#include "image/labelled.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class TextTest : public CliTest {
 protected:
  Finished run_text(const std::string& config) const {
    write_text(folder_ / "config.json", config);
    return run({"-q", "run", (folder_ / "config.json").string(), "--out", out_.string()});
  }
  Finished reference(const std::string& scene) const {
    return run(
        {"reference", scene, "--width", "32", "--height", "18", "--samples", "4", "--out", out_.string()});
  }
  static size_t count(const std::string& text, const std::string& part) {
    size_t n = 0;
    for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
    return n;
  }
};

TEST_F(TextTest, ANameOfAnyLengthIsOneShortLine) {
  for (const size_t length : {121, 26'463, 2 << 20}) {
    config_["name"] = std::string(length, 'n');
    const Finished f = run_text(config_.dump());
    expect_refused(f, 2, fmt::format("'name' has {} characters but may have 120", length));
    EXPECT_LT(f.err.size(), 400u);
  }
  config_["name"] = std::string(120, 'n');
  EXPECT_EQ(run_config().code, 0);
}

TEST_F(TextTest, NothingOfAConfigSteersTheTerminal) {
  const std::string esc = "\\u001b[2J\\u009b31m" + std::string(1 << 20, 'x');
  const std::string good = config_.dump();
  for (const char* key : {"name", "scenes", "methods", "visibility", "frame", "N", "preset", "description"}) {
    Json config = config_;
    config[key] = "@";
    std::string text = config.dump();
    text.replace(text.find('@'), 1, esc);
    const Finished f = run_text(text);
    EXPECT_EQ(f.code, 2) << key;
    EXPECT_LT(f.err.size(), 1200u) << key;
    EXPECT_EQ(f.err.find('\x1b'), std::string::npos) << key;
    EXPECT_EQ(f.err.find("\xc2\x9b"), std::string::npos) << key;
    EXPECT_EQ(f.errors().size(), 1u) << key << ": " << f.err;
  }
}

TEST_F(TextTest, WholeNumbersAndEmptyLists) {
  config_["N"] = 16.0;
  EXPECT_EQ(run_config().code, 0);
  ASSERT_EQ(report().cases.size(), 1u);
  EXPECT_EQ(report().cases[0].parameters.at("N"), 16);
  EXPECT_TRUE(contains(report().cases[0].id, "/N=16,"));
  config_["N"] = Json::array();
  expect_refused(run_config(), 2, "'N' is an empty list");
  config_["N"] = 16.5;
  expect_refused(run_config(), 2, "'N' is 16.5 but must be integer");
}

TEST_F(TextTest, AReferencePrintsTheWarningsOfItsSceneOnce) {
  Json box = box_gltf();
  box["materials"][0]["name"] = "glow\x1b[2J" + std::string(1000, 'm');
  box["materials"][0]["emissiveFactor"] = {1, 0, 0};
  const std::string scene = write_scene("square", square_scene(), box.dump());
  const Finished f = reference(scene);
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_EQ(count(f.err, "its emission is ignored"), 1u) << f.err;
  EXPECT_EQ(f.err.find('\x1b'), std::string::npos);
  EXPECT_LT(f.err.size(), 400u);
  config_["scenes"] = {scene};
  EXPECT_EQ(count(run_config().err, "its emission is ignored"), 1u);
}

TEST_F(TextTest, ABlackReferenceIsNoSuccess) {
  Json box = box_gltf();
  box["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 1}};
  const Finished f = reference(write_scene("square", square_scene(), box.dump()));
  expect_refused(f, 1, "no indirect light reaches the view: the reference is black");
  EXPECT_EQ(f.out.find("noise floor"), std::string::npos);
}

// A thousandth of a thousandth of the light is left after two bounces, and less.
TEST_F(TextTest, AReferenceThatIsNearlyBlackIsDoubted) {
  Json box = box_gltf();
  box["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {1e-4, 1e-4, 1e-4, 1}},
                                                 {"metallicFactor", 0}};
  Json scene = square_scene();
  scene["materials"] = {{{"match", "*"}, {"specular", 0}}};
  const Finished dark = reference(write_scene("square", scene, box.dump()));
  EXPECT_EQ(dark.code, 0) << dark.err;
  EXPECT_EQ(count(dark.err, "the reference is nearly black"), 1u) << dark.err;
}

TEST_F(TextTest, ImagesSayWhatTheyShow) {
  EXPECT_EQ(run_config().code, 0);
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 1u);
  const auto exr = [&](const char* image) {
    return read_exr_layers(out_ / r.cases[0].images.at(image)).attributes;
  };
  const auto indirect = exr("indirect"), reference = exr("reference"), error = exr("error");
  EXPECT_EQ(indirect.at("case"), r.cases[0].id);
  EXPECT_EQ(indirect.at("scene"), r.scenes[0].name);
  EXPECT_EQ(indirect.at("sceneHash"), r.scenes[0].hash);
  EXPECT_EQ(indirect.at("seed"), "0");
  EXPECT_TRUE(contains(indirect.at("software"), r.git.commit));
  EXPECT_TRUE(contains(indirect.at("units"), "W/(sr m^2)"));
  EXPECT_TRUE(contains(indirect.at("A"), "counts"));
  EXPECT_EQ(reference.at("reference"), r.cases[0].accuracy->reference.hash);
  EXPECT_TRUE(contains(error.at("units"), "luminance"));
  std::string png = r.cases[0].images.at("indirect");
  png.replace(png.size() - 3, 3, "png");
  EXPECT_EQ(png_labels(read_text(out_ / png)).at("case"), r.cases[0].id);
}

}  // namespace
}  // namespace vsglbench
