#include "run/preset.h"

#include "run/case_keys.h"
#include "run/config_fixture.h"

namespace vsglbench {
namespace {

// The entry's key, its preset, the config's key, the config's preset, the default: the first that is there.
TEST_F(ConfigTest, APresetFillsWhatNothingElseSays) {
  config_["preset"] = "papers/mfis16";
  config_.erase("frame");
  config_["rsm"] = 32;
  config_["methods"] = {{{"method", "fis"}, {"preset", "papers/vsgl14"}, {"N", 8}},
                        {{"method", "mfis"}},
                        {{"method", "all-texels"}},
                        {{"method", "mfis"}, {"preset", "author2024"}}};
  const Config config = load();
  ASSERT_EQ(config.cases.size(), 4u);
  const auto is = [&](size_t i, const char* key, const Json& value) {
    EXPECT_EQ(config.cases[i].parameters.at(key), value) << i << " " << key;
  };
  is(0, "width", 1920);  // of the config's preset
  is(0, "rsm", 256);     // of the entry's
  is(0, "N", 8);
  is(0, "K", 4.0);
  is(0, "visibility", "aism");
  is(0, "shading", "vsgl14");
  EXPECT_TRUE(config.cases[0].id.starts_with("cornell/fis/preset=papers-vsgl14,N=8")) << config.cases[0].id;
  is(1, "rsm", 32);  // of the config
  is(1, "K", 1.0);
  is(1, "light_clearance", "0");
  is(2, "shading", "exact");  // the method's own parameter
  is(3, "lambert_sharpness", "2.2925");
  is(3, "receiver", "sg");
  is(3, "visibility", config_.contains("visibility") ? config_["visibility"] : Json("tism"));
  EXPECT_EQ(config.resolved.at("preset"), "papers/mfis16");
}

TEST_F(ConfigTest, PresetsAreAllSound) {
  ASSERT_GE(preset_names().size(), 3u);
  for (const auto& name : preset_names()) {
    config_["preset"] = name;
    config_["methods"] = {{{"method", "fis"}}, {{"method", "vpl"}}};
    const Json keys = load_preset(name);
    for (const auto& [key, value] : keys.items()) {
      const bool known = key == "frame" || key == "ism" || key == "K" || find_case_key(key);
      EXPECT_TRUE(known) << name << " " << key;
    }
    EXPECT_EQ(load().cases.size(), 2u) << name;
  }
}

TEST_F(ConfigTest, AMissingPresetAndADiskOfTheFirstModelAreRefused) {
  config_["preset"] = "papers/mfis15";
  EXPECT_TRUE(contains(problem(), "no preset 'papers/mfis15'; did you mean 'papers/mfis16'?")) << problem();
  config_["preset"] = 3;
  EXPECT_TRUE(contains(problem(), "preset"));
  config_.erase("preset");
  config_["methods"] = {{{"method", "mfis"}, {"shading", {"vsgl16", "vsgl14"}}, {"variance", "disk"}}};
  EXPECT_TRUE(contains(problem(), "shading vsgl14 with variance disk")) << problem();
  config_["methods"] = {{{"method", "mfis"}, {"shading", {"vsgl16", "filtered"}}, {"variance", "disk"}}};
  EXPECT_TRUE(contains(problem(), "shading filtered with variance disk")) << problem();
  config_["methods"] = {{{"method", "cut"}, {"shading", "filtered"}, {"bias_reduction", {0, 0.1}}}};
  EXPECT_TRUE(contains(problem(), "shading filtered with bias_reduction")) << problem();
}

// What a preset's file may say is what a config may; the error is of that file.
TEST_F(ConfigTest, APresetOfWrongTypesIsAnErrorOfItsFile) {
  const auto refusal = [&](const std::string& text) -> std::string {
    const auto file = write("bad-preset.json", text);
    try {
      read_preset(file);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      EXPECT_TRUE(contains(e.what(), file.string() + ":"));
      return e.what();
    }
    return "no error";
  };
  EXPECT_TRUE(contains(refusal("{\n\"frame\": 3}"), ":2: 'frame' is 3 but must be object"));
  EXPECT_TRUE(contains(refusal(R"({"ism": {"size": "64"}})"), "'ism/size' '64' is not allowed"));
  EXPECT_TRUE(contains(refusal(R"({"N": "many"})"), "'N' is \"many\" but must be integer"));
  EXPECT_TRUE(contains(refusal(R"({"diffuse": "cosin"})"), "did you mean 'cosine'?"));
  EXPECT_TRUE(contains(refusal("[]"), "must be object"));
  EXPECT_TRUE(
      contains(refusal(R"({"lambert_sharpnes": "2"})"), "unknown key; did you mean 'lambert_sharpness'?"));
  EXPECT_TRUE(contains(refusal(R"({"preset": "author2024"})"), "unknown key"));
  EXPECT_EQ(refusal(R"({"K": 4, "description": "any"})"), "no error");
}

}  // namespace
}  // namespace vsglbench
