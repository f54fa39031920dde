// `run --set KEY=VALUE`.
#include "run/overrides.h"

#include "run/config_fixture.h"

namespace vsglbench {
namespace {

class OverridesTest : public ConfigTest {
 protected:
  std::string refusal(const std::vector<std::string>& settings) {
    try {
      load(parse_overrides(settings));
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::config);
      return e.what();
    }
    return "no error";
  }
  std::vector<std::string> ids_with(const std::vector<std::string>& settings) {
    std::vector<std::string> out;
    for (const Case& c : load(parse_overrides(settings)).cases) out.push_back(c.id);
    return out;
  }
};

TEST_F(OverridesTest, TakesTheConfigsPlaceForEveryEntry) {
  config_["methods"] = {{{"method", "vpl"}, {"N", {8, 16}}}, {{"method", "mfis"}, {"visibility", "ism"}}};
  EXPECT_EQ(
      ids_with({"N=4", "visibility=none"}),
      (std::vector<std::string>{"cornell/vpl/N=4,rsm=16,vis=none", "cornell/mfis/N=4,rsm=16,vis=none"}));
  EXPECT_EQ(ids_with({"rsm=[8,16]", "N=4", "visibility=none"}).size(), 4u);
}

// The entry's preset comes before the config's keys, and after what is set.
TEST_F(OverridesTest, ComesBeforePresets) {
  config_["preset"] = "papers/mfis16";
  config_["methods"] = {{{"method", "mfis"}, {"preset", "papers/vsgl14"}}, {{"method", "mfis"}}};
  const Config config = load(parse_overrides({"shading=vsgl14", "rsm=32", "light_clearance=sigma"}));
  for (const Case& c : config.cases) {
    EXPECT_EQ(c.parameters.at("shading"), "vsgl14") << c.id;
    EXPECT_EQ(c.parameters.at("rsm"), 32) << c.id;
    EXPECT_EQ(c.parameters.at("light_clearance"), "sigma") << c.id;
  }
}

// A parameter of a method's own that bears a key's name stays, as beside a key of the config.
TEST_F(OverridesTest, LeavesAMethodsOwnParameter) {
  config_["methods"] = {{{"method", "all-texels"}, {"shading", "exact"}}, {{"method", "mfis"}}};
  const Config config = load(parse_overrides({"shading=vsgl14"}));
  EXPECT_EQ(config.cases[0].parameters.at("shading"), "exact");
  EXPECT_EQ(config.cases[1].parameters.at("shading"), "vsgl14");
  config_["methods"].erase(1);
  EXPECT_TRUE(contains(refusal({"shading=vsgl14"}), "--set shading: no case of this config reads it"));
  EXPECT_TRUE(contains(refusal({"N=4"}), "--set N: no case of this config reads it"));
}

TEST_F(OverridesTest, TheReportsConfigShowsWhatRan) {
  config_["methods"] = {{{"method", "vpl"}, {"N", {8, 16}}}};
  const Json shown = load(parse_overrides({"N=4", "visibility=none"})).resolved;
  EXPECT_EQ(shown.at("N"), 4);
  EXPECT_EQ(shown.at("visibility"), "none");
  EXPECT_EQ(shown.at("methods"), Json::parse(R"([{"method": "vpl"}])"));
  EXPECT_EQ(shown.at("set"), (Json{{"N", 4}, {"visibility", "none"}}));
  EXPECT_FALSE(load().resolved.contains("set"));
}

TEST_F(OverridesTest, WhatIsWrongIsNamed) {
  EXPECT_TRUE(contains(refusal({"visibilty=none"}), "unknown key 'visibilty'; did you mean 'visibility'?"));
  EXPECT_TRUE(contains(refusal({"visibility=nome"}), "no visibility 'nome'; did you mean 'none'?"));
  EXPECT_TRUE(contains(refusal({"N=many"}), "--set N=many: \"many\" must be an integer within 0"));
  EXPECT_TRUE(contains(refusal({"N=[]"}), "empty list"));
  const std::string deep = refusal({"N=" + std::string(60000, '[') + std::string(60000, ']')});
  EXPECT_TRUE(contains(deep, "--set N=[[[")) << deep.substr(0, 300);
  EXPECT_LT(deep.size(), 500u);
  EXPECT_TRUE(contains(refusal({"N"}), "takes KEY=VALUE, such as N=64, not 'N'"));
  EXPECT_TRUE(contains(refusal({"N=1", "N=2"}), "'N' is set twice"));
  EXPECT_TRUE(contains(refusal({"diffuse=cosine"}), "--set diffuse: no case of this config reads it"));
  config_ = Json::parse(R"({"name": "g", "measure": "generation", "scenes": ["cornell"],
                            "methods": [{"method": "mfis"}]})");
  EXPECT_TRUE(contains(refusal({"visibility=none"}), "not read where only generation is measured"));
  EXPECT_EQ(refusal({"N=4"}), "no error");
}

}  // namespace
}  // namespace vsglbench
