// What cases are called.
#include "run/case_id.h"

#include <set>

#include "run/config_fixture.h"

namespace vsglbench {
namespace {

TEST_F(ConfigTest, AMethodsOwnListsAndWhatItNamesAreInTheId) {
  config_["methods"] = {{{"method", "all-texels"}, {"shading", {"exact", "vsgl16"}}},
                        {{"method", "vpl"}, {"importance_lights", {16, 64}}}};
  EXPECT_EQ(ids(), (std::vector<std::string>{"cornell/all-texels/rsm=16,vis=exact,shading=exact",
                                             "cornell/all-texels/rsm=16,vis=exact,shading=vsgl16",
                                             "cornell/vpl/N=16,rsm=16,importance_lights=16,vis=exact",
                                             "cornell/vpl/N=16,rsm=16,importance_lights=64,vis=exact"}));
}

// Two entries with one value each: the key tells them apart, also where only one of them says it.
TEST_F(ConfigTest, IdsNameTheKeysInWhichTwoEntriesOfAMethodDiffer) {
  config_["methods"] = {
      {{"method", "mfis"}, {"importance", "flux"}}, {{"method", "mfis"}}, {{"method", "fis"}}};
  EXPECT_EQ(ids(), (std::vector<std::string>{"cornell/mfis/N=16,rsm=16,vis=exact,importance=flux",
                                             "cornell/mfis/N=16,rsm=16,vis=exact,importance=own",
                                             "cornell/fis/N=16,rsm=16,vis=exact"}));
  config_["methods"] = {{{"method", "mfis"}, {"K", 4.0}}, {{"method", "mfis"}}};
  EXPECT_EQ(ids(), (std::vector<std::string>{"cornell/mfis/N=16,rsm=16,vis=exact,K=4.0",
                                             "cornell/mfis/N=16,rsm=16,vis=exact,K=1.0"}));
}

// 16.0 is the integer 16 where an integer is wanted, in an id as in a report.
TEST_F(ConfigTest, IdsNameIntegersWithoutAFraction) {
  config_["N"] = 16.0;
  config_["rsm"] = {16, 32.0};
  config_["methods"] = {{{"method", "mfis"}, {"progressive", {1, 2.0}}, {"K", {1.0, 2}}}};
  std::string all;
  for (const std::string& id : ids()) all += id + "\n";
  EXPECT_TRUE(contains(all, "mfis/N=16,rsm=16,"));
  EXPECT_TRUE(contains(all, ",rsm=32,"));
  EXPECT_TRUE(contains(all, ",progressive=2"));
  EXPECT_EQ(all.find("16.0"), std::string::npos) << all;
  EXPECT_EQ(all.find("32.0"), std::string::npos) << all;
  EXPECT_EQ(all.find("progressive=2.0"), std::string::npos) << all;
  EXPECT_TRUE(contains(all, ",K=1.0")) << "a number that is no integer is spelt as the config has it";
}

// What a preset sets differs as well as what an entry does.
TEST_F(ConfigTest, IdsNameTheKeysThatAPresetSets) {
  config_["methods"] = {{{"method", "mfis"}, {"preset", "author2024"}}, {{"method", "mfis"}}};
  const auto got = ids();
  ASSERT_EQ(got.size(), 2u);
  for (const char* key : {"diffuse", "lobes", "variance", "receiver", "lambert_sharpness"}) {
    for (const auto& id : got) EXPECT_TRUE(contains(id, fmt::format(",{}=", key)));
  }
  for (const auto& id : got) EXPECT_EQ(id.find("light_clearance"), std::string::npos) << id;
}

// Whatever two cases of one method and scene differ in stands in both ids.
TEST_F(ConfigTest, NoTwoCasesOfAMethodDifferInWhatTheirIdsHide) {
  config_["methods"] = {{{"method", "mfis"}, {"diffuse", "tokuyoshi2022"}},
                        {{"method", "mfis"}, {"light_clearance", "sigma"}, {"progressive", 2}},
                        {{"method", "mfis"}, {"preset", "papers/vsgl14"}, {"N", {8, 16}}},
                        {{"method", "all-texels"}, {"shading", {"exact", "vsgl16"}}, {"bias_reduction", 0.1}},
                        {{"method", "all-texels"}, {"shading", "vsgl14"}}};
  const Config config = load();
  std::set<std::string> seen;
  for (const Case& a : config.cases) {
    EXPECT_TRUE(seen.insert(a.id).second) << a.id;
    for (const Case& b : config.cases) {
      if (a.method != b.method) continue;
      for (const auto& [key, value] : a.parameters.items()) {
        if (!b.parameters.contains(key) || b.parameters.at(key) == value || key == "ism") continue;
        const std::string label = fmt::format("{}=", key == "visibility" ? "vis" : key);
        EXPECT_TRUE(contains(a.id, label)) << b.id;
      }
    }
  }
}

TEST_F(ConfigTest, ANumberThatIsAChoiceHasOneNameInIds) {
  config_["methods"] = {{{"method", "mfis"}, {"light_clearance", 0.0}}};
  EXPECT_EQ(ids(), std::vector<std::string>{"cornell/mfis/N=16,rsm=16,vis=exact,light_clearance=0"});
}

}  // namespace
}  // namespace vsglbench
