#include "answer/price.h"

#include <gtest/gtest.h>

#include "answer/budget.h"
#include "answer/made_report.h"

namespace vsglbench {
namespace {

TEST(Price, IsOfPairsThatDifferInOneKeyAlone) {
  MadeReport made(1, 0.001, 0);
  for (const int n : {1024, 64, 256}) {
    for (const char* shading : {"vsgl16", "vsgl14"}) {
      made.add({.parameters = {{"N", n}, {"shading", shading}},
                .passes = {{"gbuffer", 5}, {"importance.rsm", 1}, {"shade", n / 64.0}},
                .error = (shading[5] == '4' ? 1.0 : 2.0) * 640.0 / n});
    }
  }
  const PointGroup g = point_groups(made.report)[0];
  std::map<std::string, std::vector<Price>> by_key;
  for (const Price& p : prices(g)) by_key[p.key].push_back(p);
  ASSERT_EQ(by_key.size(), 2u);
  ASSERT_EQ(by_key["N"].size(), 4u);  // 64 → 256 → 1024, twice
  ASSERT_EQ(by_key["shading"].size(), 3u);
  for (const Price& p : by_key["N"]) {
    EXPECT_EQ(std::stoi(p.to), 4 * std::stoi(p.from));
    EXPECT_EQ(p.pass, "shade");
    EXPECT_NEAR(p.pass_ms, (std::stoi(p.to) - std::stoi(p.from)) / 64.0, 0.1);
    EXPECT_EQ(p.error_change, Relation::better);
    EXPECT_EQ(p.cost_change, Relation::worse);
    EXPECT_NEAR(p.error_per_ms().value(), -p.error / p.ms, 1e-12);
    EXPECT_GT(*p.error_per_ms(), 0);
  }
  for (const KnobSummary& k : knob_summaries(g, prices(g))) {
    EXPECT_NEAR(k.error_ratio, k.key == "N" ? 0.25 : 0.5, 1e-9) << k.key;
  }
}

// 4 of the RSM's resolution, 3 more of SG lobes, 5 of clustering; then against the other reference.
TEST(Budget, SwitchesOneApproximationAtATime) {
  MadeReport made(1, 0, 0);
  const auto add = [&](const std::string& method, Json parameters, double error) {
    parameters["rsm"] = 64;
    made.add({.method = method,
              .parameters = parameters,
              .passes = {{"shade", 1}},
              .error = error,
              .reference = parameters.at("visibility") == "none" ? "0" : "1"});
  };
  add("all-texels", {{"shading", "exact"}, {"visibility", "none"}}, 4);
  add("all-texels", {{"shading", "vsgl16"}, {"visibility", "none"}}, 7);
  add("all-texels", {{"shading", "vsgl14"}, {"visibility", "none"}}, 5);
  for (const auto& [visibility, error] :
       std::map<std::string, double>{{"none", 12}, {"exact", 15}, {"ism", 17}})
    add("cut", {{"shading", "vsgl16"}, {"visibility", visibility}, {"N", 64}}, error);
  std::map<std::string, double> increments;
  for (const CaseResult& c : made.report.cases) {
    if (c.parameters.at("visibility") != "ism") continue;
    for (const BudgetPart& part : error_budget(made.report, c).parts)
      increments[part.name] = part.increment.value();
  }
  const std::map<std::string, double> expected = {
      {"RSM resolution", 4}, {"SG lobes", 3}, {"clustering", 5}, {"visibility test", 3}, {"shadow maps", 2}};
  ASSERT_EQ(increments.size(), expected.size());
  for (const auto& [name, value] : expected) EXPECT_NEAR(increments[name], value, 1e-9) << name;
}

TEST(Budget, SaysWhatIsMissing) {
  MadeReport made(1, 0, 0);
  made.add({.method = "cut",
            .parameters = {{"shading", "vsgl16"}, {"visibility", "none"}, {"rsm", 64}},
            .passes = {{"shade", 1}},
            .error = 12});
  const Budget b = error_budget(made.report, made.report.cases[0]);
  ASSERT_EQ(b.parts.size(), 3u);
  EXPECT_EQ(b.parts[0].missing, "all-texels, shading exact, visibility none");
  EXPECT_FALSE(b.parts[1].error);
  EXPECT_NEAR(b.parts[2].error.value().value, 12, 1e-9);
  EXPECT_FALSE(b.parts[2].increment);  // the RSM's, the lobes' and the clusters' share of it can't be told
}

// all-texels of another picture is no step on the way to the case's.
TEST(Budget, AllTexelsMustBeTheSamePicture) {
  const Json own = {{"rsm", 64},
                    {"N", 16},
                    {"visibility", "exact"},
                    {"light_clearance", "sigma"},
                    {"K", 1},
                    {"shading", "vsgl16"},
                    {"diffuse", "cosine"},
                    {"bias_reduction", 0.5},
                    {"progressive", 1},
                    {"lambert_sharpness", "2"}};
  const auto missing = [&](const std::string& key, const Json& value) {
    MadeReport made(1, 0, 0);
    const auto add = [&](const std::string& method, const char* shading, const Json& changes) {
      Json parameters = own;
      parameters.update({{"visibility", "none"}, {"light_clearance", "0"}, {"shading", shading}});
      parameters.update(changes);
      if (method == "all-texels") parameters.erase("N"), parameters.erase("K");
      made.add({.method = method, .parameters = parameters, .passes = {{"shade", 1}}, .error = 4});
    };
    add("all-texels", "exact", {{key, value}});
    add("all-texels", "vsgl16", {{key, value}});
    add("fis", "vsgl16", Json::object());
    add("fis", "vsgl16", {{"visibility", "exact"}, {"light_clearance", "sigma"}});
    std::vector<std::string> out;
    for (const BudgetPart& part : error_budget(made.report, made.report.cases.back()).parts)
      out.push_back(part.missing);
    return out;
  };
  using Texts = std::vector<std::string>;
  const std::string lobes = "all-texels, shading vsgl16, visibility none, ";
  EXPECT_EQ(missing("progressive", 1), (Texts{"", "", "", ""}));
  EXPECT_EQ(missing("light_clearance", "sigma"), (Texts{"", "", "", ""}));
  EXPECT_EQ(missing("bias_reduction", 0), (Texts{"", lobes + "bias_reduction 0.5", "", ""}));
  EXPECT_EQ(missing("diffuse", "tokuyoshi2024"), (Texts{"", lobes + "diffuse cosine", "", ""}));
  EXPECT_EQ(missing("lambert_sharpness", "2.2925"), (Texts{"", lobes + "lambert_sharpness 2", "", ""}));
  EXPECT_EQ(missing("progressive", 4), (Texts{"all-texels, shading exact, visibility none, progressive 1",
                                              lobes + "progressive 1", "", ""}));
  EXPECT_EQ(missing("rsm", 128),
            (Texts{"all-texels, shading exact, visibility none, rsm 64", lobes + "rsm 64", "", ""}));
}

// A report from before heavy tails were told: of N=1024 one seed of four is a spike, the others are better.
TEST(Prices, SeedsTellHeavyTailsThatTheReportDoesNot) {
  MadeReport made(1, 0, 0, 16, 4);
  for (const int n : {256, 1024}) {
    CaseResult& c = made.add({.method = "vpl",
                              .parameters = {{"N", n}, {"visibility", "exact"}},
                              .passes = {{"shade", n / 256.0}},
                              .error = 2560.0 / n});
    if (n == 1024) c.seeds[2].errors.rmse *= 50;
    c.accuracy = accuracy_over_seeds(c.seeds, c.accuracy->reference);
    c.accuracy->rmse.heavy_tailed = false;
    c.accuracy->rmse.median = c.accuracy->rmse.least = c.accuracy->rmse.largest = std::nullopt;
  }
  const PointGroup group = point_groups(made.report, {.metric = "rmse"}).front();
  const Point& spiky = group.points[1];
  EXPECT_TRUE(spiky.heavy_tailed);
  EXPECT_FALSE(group.points[0].heavy_tailed);
  EXPECT_DOUBLE_EQ(spiky.error.value, 0.025);
  EXPECT_DOUBLE_EQ(spiky.error.ci95.lo, 0.025);
  EXPECT_DOUBLE_EQ(spiky.error.ci95.hi, 1.25);
  const std::vector<Price> all = prices(group);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(*all[0].error_per_ms(), 0.025, 1e-12);  // more lights buy exactness
  EXPECT_NEAR(knob_summaries(group, all).front().error_ratio, 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(error_of(*spiky.result, "rmse")->value, 0.025);
}

}  // namespace
}  // namespace vsglbench
