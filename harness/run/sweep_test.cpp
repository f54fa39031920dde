// How a config becomes cases.
#include "run/config_fixture.h"

namespace vsglbench {
namespace {

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

TEST_F(ConfigTest, AMethodsOwnDefaultsGiveWayToTheConfig) {
  config_ = Json::parse(
      R"({"name": "d", "scenes": ["cornell"], "methods": [{"method": "mfis"}, {"method": "cut"}]})");
  const auto value = [&](size_t i, const char* key) { return load().cases.at(i).parameters.at(key); };
  EXPECT_EQ(value(0, "shading"), "vsgl16");
  EXPECT_EQ(value(0, "importance_lights"), 2048);
  EXPECT_EQ(value(1, "shading"), "filtered");
  EXPECT_EQ(value(1, "light_clearance"), "sigma");
  EXPECT_EQ(value(1, "importance_lights"), 128);
  config_["importance_lights"] = 512;
  EXPECT_EQ(value(1, "importance_lights"), 512);
  config_["methods"][1]["shading"] = "vsgl16";
  EXPECT_EQ(value(1, "shading"), "vsgl16");
  config_["methods"][1].erase("shading");
  config_["preset"] = "papers/mfis16";
  EXPECT_EQ(value(1, "shading"), "vsgl16");
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

TEST_F(ConfigTest, ASweepOfMillionsIsRefused) {
  Json many = Json::array();
  for (int i = 1; i <= 2000; ++i) many.push_back(i);
  config_["methods"] = {{{"method", "vpl"}, {"N", many}, {"rsm", many}}};
  EXPECT_TRUE(contains(problem(), "more than 10000 combinations"));
}

TEST_F(ConfigTest, ASweepOfTenThousandCasesIsTheLargest) {
  Json many = Json::array();
  for (int i = 1; i <= 100; ++i) many.push_back(i);
  config_["methods"] = {{{"method", "vpl"}, {"N", many}, {"rsm", many}}};
  EXPECT_EQ(load().cases.size(), 10000u);
  config_["methods"].push_back({{"method", "fis"}});
  EXPECT_TRUE(contains(problem(), "'methods/1' makes more than 10000 combinations"));
}

// A config of a kilobyte kept the programme busy for a minute.
TEST_F(ConfigTest, CombinationsThatRepeatOneCaseCount) {
  const auto repeated = [](const char* value) { return Json(std::vector<std::string>(20, value)); };
  config_["methods"] = {{{"method", "all-texels"},
                         {"shading", "exact"},
                         {"diffuse", repeated("cosine")},
                         {"lobes", repeated("toksvig")},
                         {"lobe_filter", repeated("on")},
                         {"variance", repeated("3d")},
                         {"receiver", repeated("asg")}}};
  EXPECT_TRUE(contains(problem(), "more than 10000 combinations"));
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
