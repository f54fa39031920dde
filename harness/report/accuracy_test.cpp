// What a report says of seeds' errors: means, heavy tails, darkness, ranks.
#include <gtest/gtest.h>

#include "base/error.h"
#include "report/accuracy_notes.h"
#include "report/metric_cell.h"
#include "report/synthetic_report.h"

using namespace vsglbench;

namespace {

Errors with_bias(double bias) {
  Errors e;
  e.smape = 50;
  e.rmse = 1;
  e.rrmse = e.mrse = 1;
  e.bias = bias;
  e.pixels = 9;
  return e;
}

std::vector<SeedResult> seeds_of(const std::vector<double>& biases) {
  std::vector<SeedResult> seeds;
  for (const double b : biases) seeds.push_back({seeds.size(), with_bias(b)});
  return seeds;
}

// `vpl` on ring514: one shift of the lattice puts a near-mirror light beside a pixel.
const std::vector<double> kRing = {-0.97, -0.96, -0.95, -0.94, -0.93, -0.92, -0.91, 2.90};

CaseResult measured(const std::string& method, const std::vector<double>& smape,
                    const std::vector<double>& rmse,
                    const ReferenceInfo& reference = {"hash", 16, 1.0, 0.01}) {
  CaseResult c;
  c.scene = "cornell";
  c.method = method;
  c.id = "cornell/" + method + "/N=64";
  for (size_t i = 0; i < smape.size(); ++i) {
    Errors e = with_bias(0.1);
    e.smape = smape[i];
    e.rmse = rmse[i];
    c.seeds.push_back({i, e});
  }
  c.accuracy = accuracy_over_seeds(c.seeds, reference);
  return c;
}

}  // namespace

TEST(Accuracy, IsAMeanOverSeeds) {
  const std::vector<SeedResult> seeds = {{1, {10, 1, 0.5, 2, 0.1, 9}}, {2, {14, 3, 0.7, 4, -0.1, 9}}};
  const Accuracy a = accuracy_over_seeds(seeds, {"hash", 16, 12, std::nullopt});
  EXPECT_DOUBLE_EQ(*a.smape.value, 12);
  EXPECT_NEAR(a.smape.ci95->hi, 12 + 12.7062 * 2, 1e-3);  // t95(1) · s/√2, s = 2√2
  EXPECT_NEAR(*a.bias.value, 0, 1e-15);
  EXPECT_EQ(a.smape.formula, "smape-0-200");
  EXPECT_EQ(a.mrse.constants.at("epsilon_factor"), 0.01);
  EXPECT_EQ(a.pixels, 9u);
  EXPECT_TRUE(a.below_floor);
  EXPECT_FALSE(accuracy_over_seeds(seeds, {"hash", 16, 11.9, std::nullopt}).below_floor);
  const Accuracy one = accuracy_over_seeds({seeds[0]}, {});
  EXPECT_FALSE(one.smape.ci95);
  EXPECT_THROW(accuracy_over_seeds({}, {}), Error);
}

TEST(Accuracy, OfABlackReferenceIsUndefinedWhereItIsRelative) {
  const Accuracy a = accuracy_over_seeds({{1, {200, 1, std::nullopt, std::nullopt, std::nullopt, 9}}}, {});
  EXPECT_TRUE(a.smape.value);
  EXPECT_FALSE(a.bias.value || a.rrmse.value || a.mrse.value);
  EXPECT_EQ(a.bias.undefined, "the reference is black");
  EXPECT_EQ(a.smape_lit.undefined, "the reference is black");
  EXPECT_EQ(a.flip.undefined, "the reference is black");
}

TEST(Accuracy, FlipMayBeOfTheFirstSeedAlone) {
  std::vector<SeedResult> seeds = seeds_of({0.1, 0.2, 0.3});
  EXPECT_EQ(accuracy_over_seeds(seeds, {}).flip.undefined, "it was not measured");
  seeds[0].errors.flip = 0.25;
  seeds[0].errors.flip_p99 = 0.75;
  Accuracy a = accuracy_over_seeds(seeds, {});
  EXPECT_EQ(a.flip.value, 0.25);
  EXPECT_FALSE(a.flip.ci95);
  EXPECT_EQ(a.flip.constants.at("seeds"), 1);
  EXPECT_EQ(a.flip_p99, 0.75);
  seeds[1].errors.flip = 0.35;
  seeds[1].errors.flip_p99 = 0.25;
  a = accuracy_over_seeds(seeds, {});
  EXPECT_NEAR(*a.flip.value, 0.3, 1e-12);
  EXPECT_NEAR(*a.flip_p99, 0.5, 1e-12);
  EXPECT_EQ(a.flip.constants.at("seeds"), 2);
}

// |bias| alone would not show it: 290 % is three times 94 %. The energy is 3.9 against 0.065.
TEST(Accuracy, OneSeedThatDwarfsTheOthersIsTold) {
  const MetricResult bias = accuracy_over_seeds(seeds_of(kRing), {}).bias;
  ASSERT_TRUE(bias.heavy_tailed);
  EXPECT_NEAR(*bias.median, -0.935, 1e-12);
  EXPECT_EQ(bias.least, -0.97);
  EXPECT_EQ(bias.largest, 2.90);
  EXPECT_EQ(metric_cell(bias, 100, "{:+.0f}", std::nullopt), "-94 [-97 … +290]");
  std::vector<SeedResult> seeds = seeds_of(std::vector<double>(8, 0.1));
  seeds[3].errors.rmse = 10.5;
  EXPECT_TRUE(accuracy_over_seeds(seeds, {}).rmse.heavy_tailed);
  EXPECT_FALSE(accuracy_over_seeds(seeds, {}).bias.heavy_tailed);
  seeds[3].errors.rmse = 9.5;
  EXPECT_FALSE(accuracy_over_seeds(seeds, {}).rmse.heavy_tailed);
  EXPECT_FALSE(accuracy_over_seeds(seeds_of({-1, -1, -1}), {}).bias.heavy_tailed);  // black images
  EXPECT_FALSE(accuracy_over_seeds(seeds_of({-0.1, 0.1, 0.001}), {}).bias.heavy_tailed);
}

TEST(Accuracy, HeavyTailsAreInTheFile) {
  Report r = synthetic_report();
  r.cases[0].seeds = seeds_of(kRing);
  r.cases[0].accuracy = accuracy_over_seeds(r.cases[0].seeds, {"0123abcd", 16});
  const Json json = to_json(r);
  EXPECT_EQ(schema_violations(json, report_schema()), std::vector<std::string>());
  EXPECT_EQ(json.at("/cases/0/accuracy/bias/largest"_json_pointer), 2.90);
  EXPECT_EQ(report_from_json(json).cases[0].accuracy->bias.median, r.cases[0].accuracy->bias.median);
  EXPECT_TRUE(report_from_json(json).cases[0].accuracy->bias.heavy_tailed);
}

TEST(MetricCell, NoNumberIsAPowerOfTen) {
  const Accuracy a = accuracy_over_seeds({{1, {1000, 1}}, {2, {1400, 3}}}, {});
  EXPECT_EQ(metric_cell(a.smape, 1, "{:.2f}", 11.0), "1200.00 ± 2541");
  EXPECT_EQ(significant(1640, 3), "1640");
  EXPECT_EQ(significant(999.6, 3), "1000");
  EXPECT_EQ(significant(-12345.6, 3), "-12346");
  EXPECT_EQ(significant(0.0000123, 2), "1.2e-05");
}

TEST(MetricCell, SaysWhatANumberIsWorth) {
  const Accuracy a = accuracy_over_seeds({{1, {10, 1}}, {2, {14, 3}}}, {});
  EXPECT_EQ(metric_cell(a.smape, 1, "{:.2f}", 11.0), "12.00 ± 25");
  EXPECT_EQ(metric_cell(a.smape, 1, "{:.2f}", 12.5), "12.00 ≤ floor 12.50");
  EXPECT_EQ(metric_cell(a.bias, 1, "{:.2f}", std::nullopt), "undefined");
  EXPECT_EQ(metric_cell(MetricResult(), 1, "{:.2f}", std::nullopt), "not measured");
}

// A light that is badly placed: whatever a method makes of it is 10¹⁸ times that.
TEST(Accuracy, OfANearlyBlackReferenceIsUndefinedWhereItIsRelative) {
  ReferenceInfo dark{"hash", 16, 1.0};
  dark.light_ratio = 3e-20;
  std::vector<SeedResult> seeds = seeds_of({6e16});
  seeds[0].errors.flip = seeds[0].errors.flip_p99 = 1;
  const Accuracy a = accuracy_over_seeds(seeds, dark);
  for (const MetricResult* m : {&a.bias, &a.rrmse, &a.mrse, &a.smape_lit, &a.flip}) {
    EXPECT_FALSE(m->value) << m->formula;
    EXPECT_NE(m->undefined.find("nearly black: its mean is 3e-20"), std::string::npos);
    EXPECT_FALSE(m->formula.empty());
  }
  EXPECT_FALSE(a.flip_p99);
  EXPECT_TRUE(a.smape.value && a.rmse.value);
  dark.light_ratio = 1e-3;
  EXPECT_EQ(accuracy_over_seeds(seeds, dark).bias.value, 6e16);
}

TEST(AccuracyNotes, TellOfDarkness) {
  ReferenceInfo dark{"hash", 16, 1.0};
  dark.light_ratio = 3e-20;
  const auto notes = accuracy_notes(
      {measured("fis", {10, 11}, {1, 1}, dark), measured("vpl", {10, 11}, {1, 1}, dark)}, "cornell");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("nearly black"), std::string::npos);
  dark.light_ratio = 0.1;
  dark.black_share = 0.995;
  EXPECT_NE(accuracy_notes({measured("fis", {10, 11}, {1, 1}, dark)}, "cornell").at(0).find("99.50 %"),
            std::string::npos);
  dark.black_share = 0.98;
  EXPECT_TRUE(accuracy_notes({measured("fis", {10, 11}, {1, 1}, dark)}, "cornell").empty());
}

TEST(AccuracyNotes, TellWhereSmapeAndRmseDisagree) {
  const CaseResult spikes = measured("vpl", {49, 50, 51}, {3, 3.1, 2.9}),
                   glow = measured("mfis", {170, 171, 172}, {0.5, 0.51, 0.49});
  const auto notes = accuracy_notes({glow, spikes}, "cornell");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0],
            "SMAPE ranks vpl before mfis (SMAPE 50 and 171 %, RMSE 3 and 0.5); RMSE ranks them the other way "
            "round");
  EXPECT_TRUE(accuracy_notes({glow, spikes}, "ring514").empty());
  EXPECT_TRUE(accuracy_notes({glow, measured("vpl", {49, 50, 51}, {0.1, 0.11, 0.12})}, "cornell").empty());
}

TEST(AccuracyNotes, LeaveOutWhatIsNoDifference) {
  const CaseResult glow = measured("mfis", {170, 171, 172}, {0.5, 0.51, 0.49});
  const auto with = [&](const CaseResult& other) { return accuracy_notes({glow, other}, "cornell").size(); };
  EXPECT_EQ(with(measured("vpl", {49, 50, 51}, {0.6, 0.61, 0.62})), 1u);
  EXPECT_EQ(with(measured("vpl", {49, 50, 51}, {0.4, 0.6, 0.8})), 0u);        // intervals meet
  EXPECT_EQ(with(measured("vpl", {49, 50, 51}, {0.505, 0.505, 0.505})), 0u);  // under RMSE's floor of 0.01
  EXPECT_EQ(with(measured("vpl", {170.2, 170.2, 170.2}, {0.6, 0.61, 0.62})), 0u);  // under SMAPE's of 1
  EXPECT_EQ(with(measured("vpl", {49, 50, 51}, {0.6, 0.61, 0.62}, {"another", 16, 1.0, 0.01})), 0u);
}

TEST(AccuracyNotes, NameAtMostThreePairs) {
  std::vector<CaseResult> cases;
  for (int i = 0; i < 5; ++i) {
    cases.push_back(measured("fis", {10.0 + 5 * i}, {1 - 0.1 * i}));
    cases.back().id = "cornell/fis/N=" + std::to_string(i);
  }
  const auto notes = accuracy_notes(cases, "cornell");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("fis/N=0 before fis/N=1"), std::string::npos);
  EXPECT_NE(notes[0].find("and 7 more pairs"), std::string::npos);
}
