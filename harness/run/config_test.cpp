#include "run/config.h"

#include <set>

#include "base/error.h"
#include "run/preset.h"
#include "run/run_fixture.h"
#include "run/scene_images.h"

namespace vsglbench {
namespace {

class ConfigTest : public RunFixture {
 protected:
  Config load() { return load_config(write_config()); }
  std::vector<std::string> ids() {
    std::vector<std::string> out;
    for (const Case& c : load().cases) out.push_back(c.id);
    return out;
  }
  // The error of `config_`, or of a text, which must be a config error of one line that names file and line.
  std::string problem() { return problem_of(config_.dump(1)); }
  std::string problem_of(const std::string& text) {
    const auto path = write("bad.json", text);
    try {
      load_config(path);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      EXPECT_TRUE(contains(e.what(), path.string() + ":"));
      return e.what();
    }
    return "no error";
  }
};

TEST_F(ConfigTest, SweepsExpandInOrderWithUniqueIds) {
  config_["scenes"] = {"cornell", "ring514:above"};
  config_["methods"] = {{{"method", "mfis"}, {"N", {16, 32}}, {"visibility", {"exact", "none"}}},
                        {{"method", "vpl"}}};
  config_["rsm"] = {16, 24};
  const auto got = ids();
  const std::vector<std::string> first = {
      "cornell/mfis/N=16,rsm=16,vis=exact", "cornell/mfis/N=16,rsm=16,vis=none",
      "cornell/mfis/N=16,rsm=24,vis=exact", "cornell/mfis/N=16,rsm=24,vis=none",
      "cornell/mfis/N=32,rsm=16,vis=exact"};
  ASSERT_EQ(got.size(), 2u * (2 * 2 * 2 + 2));
  EXPECT_TRUE(std::equal(first.begin(), first.end(), got.begin()));
  EXPECT_EQ(got[8], "cornell/vpl/N=16,rsm=16,vis=exact");
  EXPECT_EQ(got[10], "ring514:above/mfis/N=16,rsm=16,vis=exact");
  EXPECT_EQ(std::set<std::string>(got.begin(), got.end()).size(), got.size());
}

TEST_F(ConfigTest, AMethodsOwnListsAndWhatItNamesAreInTheId) {
  config_["methods"] = {{{"method", "all-texels"}, {"shading", {"exact", "vsgl16"}}},
                        {{"method", "vpl"}, {"importance_lights", {16, 64}}}};
  EXPECT_EQ(ids(), (std::vector<std::string>{"cornell/all-texels/rsm=16,vis=exact,shading=exact",
                                             "cornell/all-texels/rsm=16,vis=exact,shading=vsgl16",
                                             "cornell/vpl/N=16,rsm=16,importance_lights=16,vis=exact",
                                             "cornell/vpl/N=16,rsm=16,importance_lights=64,vis=exact"}));
}

TEST_F(ConfigTest, ParametersAreResolvedWithDefaults) {
  config_ = Json::parse(R"({"name": "d", "scenes": ["cornell"], "methods": [{"method": "mfis"}]})");
  const Config config = load();
  const Case& c = config.cases.at(0);
  EXPECT_EQ(c.parameters.at("N"), 256);
  EXPECT_EQ(c.parameters.at("rsm"), 256);
  EXPECT_EQ(c.parameters.at("importance_lights"), 2048);
  EXPECT_EQ(c.parameters.at("visibility"), "exact");
  EXPECT_EQ(c.frame.width, 480u);
  for (const auto& [key, value] : c.method_parameters.items()) EXPECT_EQ(c.parameters.at(key), value);
  for (const char* key :
       {"frame", "N", "rsm", "importance_lights", "visibility", "ism", "seeds", "reference", "timing"}) {
    EXPECT_TRUE(config.resolved.contains(key)) << key;
  }
}

TEST_F(ConfigTest, UnknownKeysNameTheNearestWithTheLine) {
  EXPECT_TRUE(contains(problem_of("{\"name\": \"a\",\n\"scenes\": [\"cornell\"],\n\"sceens\": "
                                  "1,\n\"methods\": [{\"method\": \"vpl\"}]}"),
                       "bad.json:3: 'sceens' unknown key 'sceens'; did you mean 'scenes'?"));
  config_["methods"][0]["visibilty"] = "none";
  EXPECT_TRUE(contains(problem(), "unknown key 'visibilty' for vpl; did you mean 'visibility'?"));
  config_["methods"] = {{{"method", "mfis"}, {"shadding", "vsgl16"}}};
  EXPECT_TRUE(contains(problem(), "unknown key 'shadding' for mfis"));
}

TEST_F(ConfigTest, UnknownNamesAreNamed) {
  const Json good = config_;
  config_["methods"][0]["method"] = "mfsi";
  EXPECT_TRUE(contains(problem(), "did you mean 'mfis'?"));
  config_ = good;
  config_["methods"][0]["method"] = 7;
  EXPECT_TRUE(contains(problem(), "must be the name of a method"));
  config_ = good;
  config_["scenes"] = {"cornel"};
  EXPECT_TRUE(contains(problem(), "no scene 'cornel'; did you mean 'cornell'?"));
  config_["scenes"] = {"elsewhere/scene.json:view"};
  EXPECT_TRUE(contains(problem(), "elsewhere/scene.json does not exist"));
  config_ = good;
  config_["visibility"] = "exat";
  EXPECT_TRUE(contains(problem(), "'exat' is not allowed; did you mean 'exact'?"));
  config_ = good;
  config_["methods"][0]["visibility"] = {"none", "exat"};
  EXPECT_TRUE(contains(problem(), "no visibility 'exat'; did you mean 'exact'?"));
}

TEST_F(ConfigTest, WrongTypesAndRanges) {
  const auto after = [&](const char* pointer, const Json& value) {
    const Json good = config_;
    config_[Json::json_pointer(pointer)] = value;
    const std::string text = problem();
    config_ = good;
    return text;
  };
  EXPECT_TRUE(contains(after("/frame/width", 0), "0 must be at least 1"));
  EXPECT_TRUE(contains(after("/frame/height", 0), "0 must be at least 1"));
  EXPECT_TRUE(contains(after("/frame/width", 20000), "must be at most 16384"));
  EXPECT_TRUE(contains(after("/frame/width", 1.5), "must be integer"));
  EXPECT_TRUE(contains(after("/N", "many"), "must be"));
  EXPECT_TRUE(contains(after("/methods/0/N", "many"), "must be an integer within 0"));
  EXPECT_TRUE(contains(after("/methods/0/N", -1), "must be an integer within 0"));
  EXPECT_TRUE(contains(after("/methods/0/N", 1e300), "must be an integer within 0"));
  EXPECT_TRUE(contains(after("/methods/0/rsm", 0), "must be an integer within 1"));
  EXPECT_TRUE(contains(after("/methods/0/rsm", Json::array()), "empty list"));
  EXPECT_TRUE(contains(after("/methods/0/visibility", true), "no visibility 'true'"));
  EXPECT_TRUE(contains(after("/seeds", 0), "at least 1"));
  EXPECT_TRUE(contains(after("/timing/time_limit_s", 0), "over 0"));
  EXPECT_TRUE(contains(after("/timing/max_samples", 1), "1 is under min_samples, 2"));
  EXPECT_TRUE(contains(after("/reference/batches", 3), "must be even"));
  EXPECT_TRUE(contains(after("/reference/floor", "2"), "no noise floor"));
  EXPECT_TRUE(contains(after("/reference/floor", "300%"), "no noise floor"));
  EXPECT_TRUE(contains(after("/reference/time_limit_s", 5), "give one"));
  EXPECT_TRUE(contains(after("/scenes", Json::array()), "needs 1"));
  EXPECT_TRUE(contains(after("/name", "../up"), "does not match"));
}

TEST_F(ConfigTest, LightsAreNotReadByAllTexels) {
  config_["methods"] = {{{"method", "all-texels"}, {"N", 4}}};
  EXPECT_TRUE(contains(problem(), "is not read: all-texels makes a light of every texel"));
}

TEST_F(ConfigTest, ACaseThatComesTwice) {
  config_["methods"] = {{{"method", "vpl"}}, {{"method", "vpl"}}};
  EXPECT_TRUE(contains(problem(), "the case cornell/vpl/N=16,rsm=16,vis=exact comes twice"));
  config_["methods"] = {{{"method", "all-texels"}}, {{"method", "all-texels"}, {"shading", "exact"}}};
  EXPECT_TRUE(contains(problem(), "comes twice, first as cornell/all-texels/rsm=16,vis=exact"));
  config_["methods"] = {{{"method", "vpl"}, {"N", {8, 8}}}};
  EXPECT_TRUE(contains(problem(), "comes twice"));
  config_["scenes"] = {"cornell", "cornell"};
  EXPECT_TRUE(contains(problem(), "the scene cornell comes twice"));
}

TEST_F(ConfigTest, TwoNamesOfOneSceneAreRefused) {
  config_["scenes"] = {"cornell", "cornell:front"};
  EXPECT_TRUE(contains(problem(), "the scene cornell:front comes twice, first as cornell"));
  config_["scenes"] = {(data_root() / "scenes" / "cornell").string(), "cornell"};
  EXPECT_TRUE(contains(problem(), "the scene cornell comes twice, first as /"));
  config_["scenes"] = {"colonnade", "colonnade:cut"};
  EXPECT_EQ(load().cases.size(), 2u);
}

TEST_F(ConfigTest, GenerationAloneReadsNothingOfImages) {
  config_["measure"] = "generation";
  for (const char* key : {"seeds", "reference"}) {
    EXPECT_TRUE(contains(problem(), fmt::format("'{}' is not read where only generation is measured", key)));
    config_.erase(key);
  }
  EXPECT_EQ(ids(), std::vector<std::string>{"cornell/vpl/N=16,rsm=16"});
  const Config config = load();
  EXPECT_EQ(config.measure, Measure::generation);
  EXPECT_EQ(config.cases[0].frame.visibility, Visibility::none);
  config_["visibility"] = "none";
  EXPECT_TRUE(contains(problem(), "'visibility' is not read"));
  config_.erase("visibility");
  config_["methods"][0]["visibility"] = "none";
  EXPECT_TRUE(contains(problem(), "is not read where only generation is measured"));
  config_["measure"] = "everything";
  EXPECT_TRUE(contains(problem(), "measure"));
}

TEST_F(ConfigTest, TheTimeLimitHasADefault) {
  EXPECT_EQ(load().time_limit_s, 600);
  config_["time_limit_s"] = 2.5;
  EXPECT_EQ(load().time_limit_s, 2.5);
  EXPECT_EQ(load().resolved.at("time_limit_s"), 2.5);
  config_["time_limit_s"] = 0;
  EXPECT_TRUE(contains(problem(), "must be over 0"));
}

TEST_F(ConfigTest, ASweepOfMillionsIsRefused) {
  Json many = Json::array();
  for (int i = 1; i <= 2000; ++i) many.push_back(i);
  config_["methods"] = {{{"method", "vpl"}, {"N", many}, {"rsm", many}}};
  EXPECT_TRUE(contains(problem(), "more than 100000 cases"));
}

TEST_F(ConfigTest, WhatIsNotAConfig) {
  EXPECT_TRUE(contains(problem_of(""), "not JSON"));
  EXPECT_TRUE(contains(problem_of(std::string("\x00\xff\xfe{", 4)), "not JSON"));
  EXPECT_TRUE(contains(problem_of("[]"), "must be object"));
  EXPECT_TRUE(contains(problem_of("{\"name\": \"a\", \"name\": \"b\"}"), "stands here twice"));
  EXPECT_THROW(load_config(folder_), Error);
  EXPECT_THROW(load_config(folder_ / "absent.json"), Error);
}

TEST(ConfigPath, BareNamesAreThoseOfTheDataFolder) {
  EXPECT_EQ(config_path("quick"), data_root() / "configs" / "quick.json");
  EXPECT_EQ(config_path("some/where"), "some/where");
  try {
    config_path("quik");
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_TRUE(contains(e.what(), "did you mean 'quick'?"));
  }
}

TEST(Configs, EveryCommittedOneLoads) {
  for (const auto& entry : std::filesystem::directory_iterator(data_root() / "configs")) {
    if (entry.path().extension() != ".json") continue;
    if (JsonDocument::load(entry.path(), ErrorKind::config).root().contains("figure")) continue;
    EXPECT_FALSE(load_config(entry.path()).cases.empty()) << entry.path();
  }
}

// The example of configs/README.md says how many cases it makes.
TEST_F(ConfigTest, TheDocumentedExampleLoads) {
  const std::string text = read_text(data_root() / "configs" / "README.md");
  const size_t begin = text.find("```json\n") + 8;
  const auto path = write("example.json", text.substr(begin, text.find("```", begin) - begin));
  const Config config = load_config(path);
  EXPECT_EQ(config.cases.size(), 20u);
  EXPECT_TRUE(contains(text, "20 in all"));
  // Every key of the schema is in the table.
  const Json schema = Json::parse(read_text(data_root() / "harness" / "run" / "config.schema.json"));
  for (const auto& [key, rule] : schema.at("properties").items()) {
    const Json parts = rule.value("properties", Json::object());
    for (const auto& [inner, unused] : parts.items()) {
      EXPECT_TRUE(contains(text, fmt::format("`{}.{}`", key, inner)));
    }
    EXPECT_TRUE(contains(text, fmt::format("`{}", key)));
  }
}

// Whatever a scene is called, its pictures stay in the output folder.
TEST(FileName, IsOneHarmlessComponent) {
  EXPECT_EQ(file_name("cornell"), "cornell");
  EXPECT_EQ(file_name("colonnade:cut"), "colonnade@cut");
  EXPECT_EQ(file_name("N=256,rsm=256,vis=exact"), "N=256,rsm=256,vis=exact");
  std::set<std::string> seen;
  for (const std::string& name :
       {std::string(".."), std::string("."), std::string(""), std::string("../../etc/x.json"),
        std::string("/abs/scene.json"), std::string("_abs_scene.json"), std::string("a b"),
        std::string("a\nb"), std::string(1000, 'x'), std::string("\0", 1)}) {
    const std::string file = file_name(name);
    EXPECT_EQ(file.find_first_of("/\\ \n:"), std::string::npos) << file;
    EXPECT_EQ(file.find('\0'), std::string::npos);
    EXPECT_NE(file.front(), '.');
    EXPECT_LT(file.size(), 200u);
    EXPECT_TRUE(seen.insert(file).second) << file;
  }
}

// Shading is of VSGLs: a VPL case comes once, whatever is swept for the others.
TEST_F(ConfigTest, ShadingIsSweptWhereLightsAreVsgls) {
  config_["diffuse"] = {"cosine", "tokuyoshi2022"};
  config_["variance"] = "disk";
  config_["methods"] = {{{"method", "vpl"}},
                        {{"method", "mfis"}},
                        {{"method", "all-texels"}, {"shading", {"exact", "vsgl16"}}}};
  const Config config = load();
  ASSERT_EQ(config.cases.size(), 6u);
  EXPECT_FALSE(config.cases[0].parameters.contains("diffuse"));
  EXPECT_TRUE(config.cases[0].frame.shading.empty());
  EXPECT_EQ(config.cases[1].id, "cornell/mfis/N=16,rsm=16,vis=exact,diffuse=cosine");
  EXPECT_EQ(config.cases[2].parameters.at("diffuse"), "tokuyoshi2022");
  EXPECT_EQ(config.cases[2].parameters.at("variance"), "disk");
  EXPECT_EQ(config.cases[2].parameters.at("lobes"), "toksvig");
  EXPECT_EQ(shading_defines(config.cases[2].frame.shading),
            (ShaderDefines{{"DIFFUSE_MODEL", "3"}, {"VARIANCE", "1"}}));
  EXPECT_EQ(config.cases[3].id, "cornell/all-texels/rsm=16,vis=exact,shading=exact");
  EXPECT_EQ(config.cases[5].id, "cornell/all-texels/rsm=16,vis=exact,shading=vsgl16,diffuse=tokuyoshi2022");
}

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
      const bool known = key == "frame" || key == "ism" || key == "K" || case_defaults().contains(key);
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
}

// A level is the same whether it is written as a number or as text.
TEST_F(ConfigTest, LevelsAreNumbersOrNames) {
  config_["methods"] = {
      {{"method", "mfis"}, {"lambert_sharpness", {2, 2.2925}}, {"light_clearance", {0, "sigma"}}}};
  const Config config = load();
  ASSERT_EQ(config.cases.size(), 4u);
  EXPECT_EQ(config.cases[3].frame.shading.at("lambert_sharpness"), "2.2925");
  EXPECT_EQ(config.cases[3].frame.shading.at("light_clearance"), "sigma");
  EXPECT_EQ(shading_defines(config.cases[3].frame.shading),
            (ShaderDefines{{"LAMBERT_LOBE", "1"}, {"LIGHT_CLEARANCE", "1"}}));
  config_["methods"] = {{{"method", "mfis"}, {"lambert_sharpness", 2.5}}};
  EXPECT_TRUE(contains(problem(), "no lambert_sharpness '2.5'"));
}

TEST_F(ConfigTest, ShadingThatIsNotReadOrUnknownIsRefused) {
  config_["methods"] = {{{"method", "vpl"}, {"diffuse", "cosine"}}};
  EXPECT_TRUE(contains(problem(), "is not read: vpl makes VPLs"));
  config_["methods"] = {{{"method", "mfis"}, {"diffuse", "tokuyoshi2023"}}};
  EXPECT_TRUE(contains(problem(), "no diffuse 'tokuyoshi2023'"));
  config_["methods"] = {{{"method", "mfis"}}};
  config_["variance"] = 3;
  EXPECT_TRUE(contains(problem(), "variance"));
}

}  // namespace
}  // namespace vsglbench
