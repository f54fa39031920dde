// How each seed's lights lie on the RSM, in the reports of whole frames.
#include "run/lights_run.h"
#include "run/run_fixture.h"
#include "run/runner.h"

namespace vsglbench {
namespace {

class KernelsTest : public RunFixture {
 protected:
  Report run() {
    RunOptions options;
    options.config = write_config();
    options.out = out_;
    options.argv = {"vsglbench", "run"};
    EXPECT_EQ(run_config(options).exit_code, 0);
    expect_sound(out_ / "report.json");
    return read_report(out_ / "report.json");
  }
  std::vector<LightsResult> lights(uint32_t seed) {
    LightsOptions options;
    options.config = write_config();
    options.out = out_ / "lights";
    options.seed = seed;
    options.argv = {"vsglbench", "lights"};
    return run_lights(options);
  }
};

// `vsglbench lights` simulates all effects, a run those that its scene calls for: sums of the PDF are rounded
// otherwise.
void expect_near(const Json& a, const Json& b, const std::string& id) {
  ASSERT_EQ(a.size(), b.size()) << id;
  for (const auto& [key, value] : a.items())
    EXPECT_NEAR(value.get<double>(), b.at(key).get<double>(), 1e-6) << id << " " << key;
}

// A frame's own lights, and its own PDF: the numbers are those that `vsglbench lights` has of the seed.
TEST_F(KernelsTest, EverySeedHasThoseOfItsLights) {
  config_["methods"] = {
      {{"method", "mfis"}}, {{"method", "kmeans2d"}}, {{"method", "vpl"}}, {{"method", "all-texels"}}};
  config_["visibility"] = "none";
  const Report r = run();
  ASSERT_EQ(r.cases.size(), 4u);
  for (uint32_t seed = 0; seed < 2; ++seed) {
    const auto listed = lights(seed);
    for (size_t i = 0; i < 3; ++i) {
      const CaseResult& c = r.cases[i];
      ASSERT_EQ(c.seeds.size(), 2u) << c.id;
      const auto of = std::ranges::find(c.seeds, seed, &SeedResult::seed);
      ASSERT_EQ(of->coverage.has_value(), c.method != "vpl") << c.id;
      ASSERT_EQ(of->kernels.has_value(), c.method == "mfis") << c.id;
      if (of->coverage) expect_near(part_to_json(*of->coverage), part_to_json(*listed[i].coverage), c.id);
      EXPECT_EQ(of->coverage && of->coverage->pdf_gap, of->coverage.has_value()) << c.id;
      if (of->kernels) expect_near(part_to_json(*of->kernels), part_to_json(*listed[i].kernels), c.id);
    }
  }
  const SeedResult &first = r.cases[0].seeds[0], &second = r.cases[0].seeds[1];
  EXPECT_NE(first.kernels->spread, second.kernels->spread) << "two seeds with the same lights";
  EXPECT_NEAR(first.kernels->mean, 1 + *first.coverage->pdf_overlap - *first.coverage->pdf_gap, 1e-9);
  EXPECT_EQ(*r.cases[0].generate->overlap,
            std::ranges::find(r.cases[0].seeds, 0u, &SeedResult::seed)->coverage->overlap);
  EXPECT_FALSE(r.cases[3].seeds.at(0).kernels.has_value());
}

// As the list and the table say it.
TEST_F(KernelsTest, TheListOfLightsHasThem) {
  config_["methods"] = {{{"method", "mfis"}}};
  const LightsResult of = lights(1).at(0);
  ASSERT_EQ(of.status, Status::ok) << of.error;
  const Json json = Json::parse(read_text(out_ / "lights" / of.folder / "lights.json"));
  EXPECT_EQ(json.at("coverage").at("kernel_largest"), of.kernels->largest);
  EXPECT_EQ(json.at("coverage").at("kernel_over"), of.kernels->over);
  double largest = 0;
  for (const Json& light : json.at("lights")) {
    EXPECT_TRUE(light.contains("footprint"));
    largest = std::max(largest, light.at("mass").get<double>());
  }
  EXPECT_EQ(largest, of.kernels->largest);
  const std::string table = read_text(out_ / "lights" / "coverage.csv");
  EXPECT_TRUE(contains(table, "pdf_gap,kernel_largest,kernel_over,"));
  EXPECT_TRUE(contains(table, fmt::format(",{},{},", of.kernels->largest, of.kernels->over)));
}

}  // namespace
}  // namespace vsglbench
