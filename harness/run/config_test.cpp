#include "run/config.h"

#include "run/config_fixture.h"

namespace vsglbench {
namespace {

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

TEST_F(ConfigTest, EffectsAreNamedInALine) {
  const Json good = config_;
  const auto problem_with = [&](const Json& keys) {
    config_ = good;
    config_.update(keys);
    const std::string text = problem();
    EXPECT_LT(text.size() - text.find("bad.json"), 150u) << text;
    return text;
  };
  EXPECT_TRUE(contains(problem_with({{"skip_effects", "oclusion"}}),
                       "'skip_effects' no effect 'oclusion'; did you mean 'occlusion'?"));
  EXPECT_TRUE(contains(problem_with({{"force_effects", {"", "occlusion,normal_map"}}}),
                       "did you mean 'normal_maps'?"));
  EXPECT_TRUE(contains(problem_with({{"skip_effects", "caustics"}}),
                       "no effect 'caustics'; see vsglbench list effects"));
  EXPECT_TRUE(
      contains(problem_with({{"force_effects", "all,all"}}), "'all' stands for every effect; give it alone"));
  EXPECT_TRUE(contains(problem_with({{"skip_effects", "moving_light"}}),
                       "moving_light is the scene's: it can be neither forced nor skipped"));
  EXPECT_TRUE(contains(problem_with({{"skip_effects", Json::array()}}), "is an empty list; give at least 1"));
  EXPECT_TRUE(contains(problem_with({{"skip_effects", 3}}), "must be string"));
  EXPECT_TRUE(contains(problem_with({{"skip_effects", "occlusion"}, {"force_effects", {"", "all"}}}),
                       "both forces and skips occlusion; name it in one of the two"));
  config_ = good;
  config_["methods"][0]["skip_effects"] = "caustics";
  EXPECT_TRUE(contains(problem(), "no effect 'caustics'"));
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
  EXPECT_TRUE(contains(after("/price_effects", -1), "at least 0"));
  EXPECT_TRUE(contains(after("/price_effects", true), "must be integer"));
  EXPECT_TRUE(contains(after("/timing/time_limit_s", 0), "over 0"));
  EXPECT_TRUE(contains(after("/timing/max_samples", 1), "1 is under min_samples, 2"));
  EXPECT_TRUE(contains(after("/reference/batches", 3), "must be even"));
  EXPECT_TRUE(contains(after("/reference/floor", "2"), "no noise floor"));
  EXPECT_TRUE(contains(after("/reference/floor", "300%"), "no noise floor"));
  EXPECT_TRUE(contains(after("/reference/time_limit_s", 5), "give one"));
  EXPECT_TRUE(contains(after("/scenes", Json::array()), "give at least 1"));
  EXPECT_TRUE(contains(after("/name", "../up"), "does not match"));
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
  config_["price_effects"] = 4;
  EXPECT_NE(problem(), "no error");
  config_.erase("price_effects");
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

TEST_F(ConfigTest, AScaleReplacesKeysAndNothingElse) {
  config_["frame"] = {{"width", 100}, {"height", 50}};
  config_["N"] = 256;
  config_["rsm"] = 64;
  config_["scales"] = {{"quick", {{"frame", {{"width", 20}}}, {"N", {4, 16}}}}, {"huge", {{"rsm", 128}}}};
  const auto path = write_config();
  const Config as_it_is = load_config(path), quick = load_config(path, Json::object(), "quick");
  EXPECT_EQ(as_it_is.cases[0].frame.width, 100u);
  EXPECT_EQ(as_it_is.cases[0].frame.lights, 256u);
  EXPECT_FALSE(as_it_is.resolved.contains("scale"));
  EXPECT_FALSE(as_it_is.resolved.contains("scales"));
  EXPECT_EQ(quick.cases.size(), 2 * as_it_is.cases.size());
  EXPECT_EQ(quick.cases[0].frame.width, 20u);
  EXPECT_EQ(quick.cases[0].frame.height, 50u);  // objects are merged
  EXPECT_EQ(quick.cases[0].frame.lights, 4u);
  EXPECT_EQ(quick.cases[0].frame.rsm, 64u);
  EXPECT_EQ(quick.resolved["scale"], "quick");
  EXPECT_EQ(load_config(path, Json::object(), "huge").cases[0].frame.rsm, 128u);
}

TEST_F(ConfigTest, AScaleThatIsAbsentOrWrongIsTold) {
  const auto problem_at = [&](const std::string& scale) {
    try {
      load_config(write_config(), Json::object(), scale);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_TRUE(contains(problem_at("quick"), "has no scale 'quick', nor any other"));
  config_["scales"] = {
      {"small", {{"N", 4}}}, {"wrong", {{"width", 4}}}, {"nested", {{"scales", Json::object()}}}};
  EXPECT_TRUE(contains(problem_at("quick"), "has no scale 'quick'; it has small, wrong, nested"));
  EXPECT_TRUE(contains(problem_at("wrong"), "unknown key 'width'")) << problem_at("wrong");
  EXPECT_TRUE(contains(problem_at("wrong"), "'scales/wrong'")) << problem_at("wrong");
  EXPECT_TRUE(contains(problem_at("nested"), "has scales of its own"));
  config_["scales"] = 3;
  EXPECT_TRUE(contains(problem(), "must be object"));
}

TEST_F(ConfigTest, TheTimeLimitHasADefault) {
  EXPECT_EQ(load().time_limit_s, 600);
  config_["time_limit_s"] = 2.5;
  EXPECT_EQ(load().time_limit_s, 2.5);
  EXPECT_EQ(load().resolved.at("time_limit_s"), 2.5);
  config_["time_limit_s"] = 0;
  EXPECT_TRUE(contains(problem(), "must be over 0"));
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

// A key that is needed and is not there is often there under another name.
TEST_F(ConfigTest, AKeyThatIsLackingIsFoundMisspelt) {
  EXPECT_TRUE(contains(problem_of("{\"name\": \"a\",\n\"scenes\": [\"cornell\"],\n"
                                  "\"method\": [{\"method\": \"vpl\"}]}"),
                       "bad.json:3: 'method' unknown key 'method'; did you mean 'methods'?"));
  const Json good = config_;
  config_.erase("scenes");
  config_["scene"] = "cornell";
  EXPECT_TRUE(contains(problem(), "unknown key 'scene'; did you mean 'scenes'?"));
  config_ = good;
  config_["methods"] = {{{"methods", "vpl"}}};
  EXPECT_TRUE(contains(problem(), "unknown key 'methods'; did you mean 'method'?"));
  config_["methods"] = {{{"N", 4}}};
  EXPECT_TRUE(contains(problem(), "'methods/0' lacks 'method'"));
  config_["methods"] = {{{"method", "vpl"}, {"seeds", 4}}};
  EXPECT_TRUE(contains(problem(), "seeds' is a key of the whole config, not of an entry"));
}

}  // namespace
}  // namespace vsglbench
