#include "answer/claims.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "answer/claim_pairs.h"
#include "answer/made_report.h"
#include "base/file.h"

namespace vsglbench {
namespace {

PaperClaim claim_of(Json a, Json b, Says says = Says::less) {
  PaperClaim c;
  c.name = "made";
  c.a = std::move(a);
  c.b = std::move(b);
  c.both = Json::object();
  c.says = says;
  c.metrics = {"rmse"};
  c.scenes = {"*"};
  return c;
}

MadeCase made(const std::string& method, int n, double error, double ms = 1,
              const std::string& scene = "box") {
  return {.scene = scene,
          .method = method,
          .parameters = {{"N", n}, {"visibility", "none"}},
          .passes = {{"generate.rsm.sample", 0.5 * ms}, {"shade", 0.5 * ms}},
          .error = error};
}

ClaimRow only_row(const Report& report, const PaperClaim& claim) {
  const TriedClaim tried = try_claim(report, claim);
  EXPECT_EQ(tried.rows.size(), 1u);
  return tried.rows.at(0);
}

// Seeds move all methods alike by 30 %, so that intervals overlap: only pairs of seeds tell.
TEST(Claims, HoldsWhereEveryPairIsAsSaidSeedBySeed) {
  MadeReport r(1, 0, 0.3);
  for (const int n : {64, 256, 1024}) {
    r.add(made("a", n, 0.9 * 100.0 / n));
    r.add(made("b", n, 100.0 / n));
  }
  const ClaimRow row = only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}));
  EXPECT_EQ(row.ruling, Ruling::holds);
  EXPECT_EQ(row.pairs, 3u);  // at equal N alone
  EXPECT_EQ(row.holding, 3u);
  EXPECT_NEAR(row.ratio, 0.9, 1e-9);
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}, Says::no_more)).ruling,
            Ruling::holds);
}

TEST(Claims, OneThatIsWrongIsSaidNotToHold) {
  MadeReport r(1, 0, 0.3);
  for (const int n : {64, 256}) {
    r.add(made("a", n, 1.1 * 100.0 / n));
    r.add(made("b", n, 100.0 / n));
  }
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}})).ruling, Ruling::does_not_hold);
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}, Says::no_more)).ruling,
            Ruling::does_not_hold);
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}, Says::more)).ruling,
            Ruling::holds);
  PaperClaim twice = claim_of({{"method", "a"}}, {{"method", "b"}});
  twice.factor = 1.2;  // 1.1 is less than that
  EXPECT_EQ(only_row(r.report, twice).ruling, Ruling::holds);
}

TEST(Claims, HoldsInPartWherePairsContradict) {
  MadeReport r(1, 0, 0.3);
  for (const auto& [n, factor] : std::map<int, double>{{64, 0.5}, {256, 1.2}}) {
    r.add(made("a", n, factor * 100.0 / n));
    r.add(made("b", n, 100.0 / n));
  }
  const ClaimRow row = only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}));
  EXPECT_EQ(row.ruling, Ruling::in_part);
  EXPECT_EQ(row.holding, 1u);
  EXPECT_EQ(row.contrary, 1u);
}

TEST(Claims, IsUndecidedWhereSeedsDoNotTell) {
  MadeReport r(1, 0, 0);
  r.add(made("a", 64, 10));
  r.add(made("b", 64, 10));
  for (size_t s = 0; s < 8; ++s) r.report.cases[0].seeds[s].errors.rmse *= s % 2 == 0 ? 1.5 : 0.6;
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}})).ruling, Ruling::undecided);
}

// Seeds that lack it, or have none of it, are not compared.
TEST(Claims, HowTheLightsLieIsComparedSeedBySeed) {
  MadeReport r(1, 0, 0);
  r.add(made("a", 64, 10));
  r.add(made("b", 64, 10));
  const std::map<std::string, double> wanted = {{"overlap", 0.5},          {"gap", 0.25},
                                                {"pdf_overlap", 0.75},     {"pdf_gap", 0.2},
                                                {"kernel_largest", 0.125}, {"kernel_over", 0.1}};
  for (size_t s = 0; s < 8; ++s) {
    const double all = 0.01 * static_cast<double>(1 + s);  // what seeds differ in
    SeedResult &a = r.report.cases[0].seeds[s], &b = r.report.cases[1].seeds[s];
    b.coverage = Coverage{all, all, all, all};
    b.kernels = KernelStats{.largest = all, .over = s == 3 ? 0 : all};
    a.coverage = Coverage{0.5 * all, 0.25 * all, 0.75 * all, 0.2 * all};
    a.kernels = KernelStats{.largest = 0.125 * all, .over = 0.1 * all};
  }
  for (const auto& [metric, ratio] : wanted) {
    PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
    claim.metrics = {metric};
    const ClaimRow row = only_row(r.report, claim);
    EXPECT_EQ(row.ruling, Ruling::holds) << metric;
    EXPECT_NEAR(row.ratio, ratio, 1e-9) << metric;
  }
  for (SeedResult& s : r.report.cases[1].seeds) s.kernels.reset(), s.coverage->pdf_gap.reset();
  for (const char* metric : {"kernel_largest", "pdf_gap"}) {
    PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
    claim.metrics = {metric};
    EXPECT_EQ(only_row(r.report, claim).why, fmt::format("{} was not measured for two seeds", metric));
  }
}

// A setting of 0.001 stands in a report as the nearest single-precision number.
TEST(Claims, SettingsAreComparedInSinglePrecision) {
  MadeReport r(1, 0, 0.1);
  for (const double alpha : {0.0, 0.001}) {
    MadeCase c = made("fis", 64, alpha > 0 ? 5 : 10);
    c.parameters["bias_reduction"] = static_cast<double>(static_cast<float>(alpha));
    r.add(c);
  }
  const ClaimRow row = only_row(r.report, claim_of({{"bias_reduction", 0.001}}, {{"bias_reduction", 0}}));
  EXPECT_EQ(row.ruling, Ruling::holds) << row.why;
  EXPECT_NEAR(row.ratio, 0.5, 1e-9);
}

// A set without a too large kernel counts as one with half of one.
TEST(Claims, NoTooLargeKernelIsFewerThanSome) {
  MadeReport r(1, 0, 0.1);
  r.add(made("a", 64, 10));
  r.add(made("b", 64, 10));
  for (CaseResult& c : r.report.cases) {
    c.generate.emplace().lights = 64;
    for (SeedResult& s : c.seeds)
      s.kernels = KernelStats{.largest = 1, .over = c.method == "a" ? 0 : 3.5 / 64};
  }
  PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
  claim.metrics = {"kernel_over"};
  const ClaimRow row = only_row(r.report, claim);
  EXPECT_EQ(row.ruling, Ruling::holds);
  EXPECT_NEAR(row.ratio, 0.5 / 4, 1e-9);
}

// Two sets with the same too large kernels are alike; two without any tell nothing.
TEST(Claims, NothingBesideNothingIsNoRatio) {
  MadeReport r(1, 0, 0.1);
  r.add(made("a", 64, 10));
  r.add(made("b", 64, 10));
  const auto row_with = [&](double over) {
    for (CaseResult& c : r.report.cases) {
      c.generate.emplace().lights = 64;
      for (SeedResult& s : c.seeds) s.kernels = KernelStats{.largest = 1, .over = over};
    }
    PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
    claim.metrics = {"kernel_over"};
    return only_row(r.report, claim);
  };
  EXPECT_EQ(row_with(0).ruling, Ruling::not_run);
  EXPECT_EQ(row_with(0.125).ruling, Ruling::does_not_hold);
}

TEST(Claims, SaysWhatWasNotRun) {
  MadeReport r(1, 0, 0.1);
  r.add(made("a", 64, 10));
  const ClaimRow without = only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}));
  EXPECT_EQ(without.ruling, Ruling::not_run);
  EXPECT_EQ(without.why, "no case of b");
  r.add(made("b", 256, 10));
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "a"}}, {{"method", "b"}})).why,
            "no two cases alike in all else");
  PaperClaim spikes = claim_of({{"method", "a"}}, {{"method", "b"}});
  spikes.metrics = {"p99_9"};
  EXPECT_EQ(only_row(r.report, spikes).why, "p99_9 was not measured for two seeds");
  spikes.scenes = {"ring*"};
  EXPECT_TRUE(try_claim(r.report, spikes).rows.empty());
}

// Whatever neither side names must be equal; K of one side alone is not asked of the other.
TEST(Claims, PairsAreAlikeInAllThatIsNotNamed) {
  MadeReport r(1, 0, 0.1);
  for (const char* shading : {"vsgl14", "vsgl16"}) {
    for (const double k : {1.0, 4.0}) {
      MadeCase c = made("mfis", 64, k == 4 ? 20 : 10);
      c.parameters["shading"] = shading;
      c.parameters["K"] = k;
      r.add(c);
    }
  }
  r.add(made("vpl", 64, 40));
  const ClaimRow blur = only_row(r.report, claim_of({{"K", {2, 4}}}, {{"K", 1}}, Says::more));
  EXPECT_EQ(blur.pairs, 2u);
  EXPECT_NEAR(blur.ratio, 2, 1e-9);
  EXPECT_EQ(only_row(r.report, claim_of({{"method", "mfis"}, {"K", 1}}, {{"method", "vpl"}})).pairs, 2u);
}

// b has the error 100/ms; a 90/ms: at equal time always less, at equal N, where it takes twice as long, half.
TEST(Claims, EqualTimeIsReadOffTheOtherSidesLadder) {
  MadeReport r(1, 0, 0.2);
  for (const int n : {64, 128, 256}) {
    r.add(made("a", n, 90.0 / (2 * n), 2 * n));
    r.add(made("b", n, 100.0 / n, n));
  }
  PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
  EXPECT_NEAR(only_row(r.report, claim).ratio, 0.45, 1e-9);
  claim.equal_time = true;
  const ClaimRow row = only_row(r.report, claim);
  EXPECT_EQ(row.ruling, Ruling::holds);
  EXPECT_EQ(row.pairs, 2u);  // at 512 ms b was not measured
  EXPECT_NEAR(row.ratio, 0.9, 1e-6);
}

// Noise decides nothing, neither that a time is longer nor that it is not.
TEST(Claims, TimesAreComparedBeyondTheirNoise) {
  MadeReport r(1, 0.001, 0);
  r.add(made("a", 64, 10, 1.02));
  r.add(made("b", 64, 10, 1));
  PaperClaim more = claim_of({{"method", "a"}}, {{"method", "b"}}, Says::more), no_more = more;
  no_more.says = Says::no_more;
  more.metrics = no_more.metrics = {"time:method"};
  EXPECT_EQ(only_row(r.report, more).ruling, Ruling::holds);
  EXPECT_EQ(only_row(r.report, no_more).ruling, Ruling::does_not_hold);
  r.report.aa = {{"box", "x", "y", {{"method", {1, {0.9, 1.1}}, 0.1}}}};
  EXPECT_EQ(only_row(r.report, more).ruling, Ruling::undecided);
  EXPECT_EQ(only_row(r.report, no_more).ruling, Ruling::undecided);
}

// Of a, one pass takes longer and another less, so that the sum of the half is the same.
TEST(Claims, SinglePassesAreCompared) {
  MadeReport r(1, 0.001, 0);
  for (const double s : {0.5, 1.0}) {
    MadeCase c = made(s < 1 ? "a" : "b", 64, 10);
    c.passes = {
        {"generate.rsm.sum", s}, {"generate.rsm.sum2", s}, {"generate.rsm.sort", 3 - 2 * s}, {"shade", 4}};
    if (s == 1) c.passes["importance.rsm"] = 1;
    r.add(c);
  }
  PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
  const auto tried = [&](const std::string& metric) {
    claim.metrics = {metric};
    return only_row(r.report, claim);
  };
  EXPECT_EQ(tried("time:pass:generate.rsm.sum*").ruling, Ruling::holds);
  EXPECT_NEAR(tried("time:pass:generate.rsm.sum*").ratio, 0.5, 0.01);
  EXPECT_NEAR(tried("time:pass:generate.rsm.sort").ratio, 2, 0.01);
  EXPECT_EQ(tried("time:pass:generate.rsm.sort").ruling, Ruling::does_not_hold);
  EXPECT_NEAR(tried("time:pass:generate.*").ratio, 1, 0.01);
  EXPECT_EQ(tried("time:pass:nothing*").ruling, Ruling::not_run);
  EXPECT_EQ(tried("time:pass:nothing*").why, "no pass of a that takes time is named nothing*");
  EXPECT_EQ(tried("time:pass:importance*").why, "no pass of a that takes time is named importance*");
  std::swap(claim.a, claim.b);
  EXPECT_EQ(tried("time:pass:importance*").why, "no pass of a that takes time is named importance*");
  std::swap(claim.a, claim.b);
  // The noise is that of the pass's own time.
  r.report.aa = {{"box", "x", "y", {{"generate", {1, {0.4, 2.5}}, 1.5}}}};
  EXPECT_EQ(tried("time:pass:generate.rsm.sum*").ruling, Ruling::undecided);
  r.report.aa = {{"box", "x", "y", {{"shade", {1, {0.4, 2.5}}, 1.5}}}};
  EXPECT_EQ(tried("time:pass:generate.rsm.sum*").ruling, Ruling::holds);
  const std::string text = claims_text(r.report, {try_claim(r.report, claim)}, true);
  EXPECT_NE(text.find("`time:pass:generate.rsm.sum*`"), std::string::npos);
}

// Seeds move both alike by 30 %, and a has so many times what b has.
TEST(Claims, WhatASeedsImageShowsIsComparedSeedBySeed) {
  MadeReport r(1, 0, 0);
  for (const char* method : {"a", "b"}) r.add(made(method, 64, 10));
  for (CaseResult& c : r.report.cases) {
    const double f = c.method == "a" ? 1 : 2;
    for (SeedResult& s : c.seeds) {
      const double scatter = 1 + 0.3 * static_cast<double>(s.seed % 3);
      s.detail = 0.3 * f * scatter;
      s.spikes = 0.003 * f * scatter;
      s.cancellation_rate = 0.2 * f * scatter;
      s.region = RegionErrors{f * scatter, 3 * f * scatter, -0.1, 0.1 * f * scatter};
    }
  }
  PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
  const auto tried = [&](const std::string& metric) {
    claim.metrics = {metric};
    return only_row(r.report, claim);
  };
  for (const char* metric : {"detail", "cancellation_rate", "region.rmse", "region.smape", "region.detail"}) {
    EXPECT_EQ(tried(metric).ruling, Ruling::holds) << metric;
    EXPECT_NEAR(tried(metric).ratio, 0.5, 1e-9) << metric;
  }
  EXPECT_NEAR(tried("rmse").ratio, 1, 1e-9);
  // A seed that has none is left out, and so is one whose detail is gone.
  r.report.cases[0].seeds[0].detail = -0.2;
  r.report.cases[1].seeds[1].detail.reset();
  EXPECT_NEAR(tried("detail").ratio, 0.5, 1e-9);
  for (SeedResult& s : r.report.cases[0].seeds) s.detail = 0;
  EXPECT_EQ(tried("detail").why, "detail was not measured above 0 for two seeds");
  for (SeedResult& s : r.report.cases[1].seeds) s.region.reset();
  EXPECT_EQ(tried("region.rmse").why, "region.rmse was not measured for two seeds");
}

// Of 1000 pixels: none beside none is no difference, one beside none not endless, many beside many as they
// are.
TEST(Claims, SpikesAreComparedWithHalfAPixelMore) {
  PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
  claim.metrics = {"spikes"};
  for (const auto& [a, b] : {std::pair(0, 0), std::pair(1, 0), std::pair(100, 200)}) {
    MadeReport r(1, 0, 0);
    for (const char* method : {"a", "b"}) r.add(made(method, 64, 10));
    for (SeedResult& s : r.report.cases[0].seeds) s.spikes = a / 1000.0;
    for (SeedResult& s : r.report.cases[1].seeds) s.spikes = b / 1000.0;
    EXPECT_NEAR(only_row(r.report, claim).ratio, (a + 0.5) / (b + 0.5), 1e-9) << a << " beside " << b;
  }
}

MadeCase moving(const std::string& method, double k, double flicker, double detail = 1) {
  MadeCase c = made(method, 64, 10);
  c.parameters["K"] = k;
  c.flicker = flicker;
  c.detail = detail;
  return c;
}

PaperClaim flicker_claim(const std::string& metric) {
  PaperClaim c = claim_of({{"method", "mfis"}}, {{"method", "fis"}});
  c.metrics = {metric};
  return c;
}

// Seeds move both methods alike by 30 %.
TEST(Claims, FlickerIsComparedSeedBySeedAtEqualK) {
  for (const char* metric : {"temporal.derivative", "temporal.static"}) {
    for (const auto& [factor, ruling] : std::map<double, Ruling>{
             {0.9, Ruling::holds}, {1.0, Ruling::does_not_hold}, {1.1, Ruling::does_not_hold}}) {
      MadeReport r(1, 0, 0.3);
      for (const double k : {1.0, 4.0}) {
        r.add(moving("mfis", k, factor / k));
        r.add(moving("fis", k, 1 / k));
      }
      const ClaimRow row = only_row(r.report, flicker_claim(metric));
      EXPECT_EQ(row.ruling, ruling) << metric << factor;
      EXPECT_EQ(row.pairs, 2u);
      EXPECT_NEAR(row.ratio, factor, 1e-9);
    }
  }
}

// Without effect, and with noise of each case's own, nothing is said.
TEST(Claims, FlickerWithoutEffectIsUndecided) {
  for (const char* metric : {"temporal.derivative", "temporal.static"}) {
    size_t said = 0;
    for (uint64_t trial = 0; trial < 100; ++trial) {
      MadeReport r(1, 0, 0);
      std::mt19937_64 random(trial);
      std::normal_distribution<> noise(0, 0.1);
      for (const char* method : {"mfis", "fis"}) {
        Temporal& t = *r.add(moving(method, 1, 1)).temporal;
        for (double& v : t.derivative.values) v *= std::exp(noise(random));
        for (double& v : t.still->series) v *= std::exp(noise(random));
      }
      said += only_row(r.report, flicker_claim(metric)).ruling != Ruling::undecided;
    }
    EXPECT_LE(said, 10u) << metric;
  }
}

// K of 1, 2, 4 and 16 make three pairs of each method, not six.
TEST(Claims, StepsCompareEachValueWithTheNextSmaller) {
  MadeReport r(1, 0, 0.3);
  for (const char* method : {"mfis", "fis"}) {
    for (const double k : {1.0, 2.0, 4.0, 16.0}) r.add(moving(method, k, 1 / k, 1 / std::sqrt(k)));
  }
  r.add(made("vpl", 64, 10)).temporal = r.report.cases.front().temporal;  // has no K
  PaperClaim claim = claim_of(Json::object(), Json::object());
  claim.step = "K";
  claim.metrics = {"temporal.derivative"};
  const ClaimRow row = only_row(r.report, claim);
  EXPECT_EQ(row.ruling, Ruling::holds);
  EXPECT_EQ(row.pairs, 6u);
  EXPECT_NEAR(row.lowest, 0.25, 1e-9);
  EXPECT_NEAR(row.highest, 0.5, 1e-9);
  claim.says = Says::more;
  EXPECT_EQ(only_row(r.report, claim).ruling, Ruling::does_not_hold);
  claim.says = Says::less;
  claim.metrics = {"temporal.detail"};
  claim.both = {{"method", "fis"}};
  EXPECT_EQ(only_row(r.report, claim).pairs, 3u);
  EXPECT_EQ(only_row(r.report, claim).ruling, Ruling::holds);
  r.report.cases[6].temporal->detail->values[0] = -0.1;  // fis of K = 4: no pair of it has a ratio
  EXPECT_EQ(only_row(r.report, claim).pairs, 1u);
  claim.step = "k";
  EXPECT_EQ(only_row(r.report, claim).why, "no case of fis with k");
}

TEST(Claims, SaysWhatOfMotionIsMissing) {
  MadeReport r(1, 0, 0.3);
  r.add(made("mfis", 64, 10));
  r.add(made("fis", 64, 10));
  for (const char* metric : {"temporal.derivative", "temporal.static", "temporal.detail"})
    EXPECT_EQ(only_row(r.report, flicker_claim(metric)).why, "was not measured in motion");
  MadeReport two(1, 0, 0.3, 16, 2);
  two.add(moving("mfis", 1, 0.5));
  two.add(moving("fis", 1, 1));
  EXPECT_EQ(only_row(two.report, flicker_claim("temporal.derivative")).pairs, 1u);
  EXPECT_EQ(only_row(two.report, flicker_claim("temporal.static")).why,
            "temporal.static was not measured for three seeds");
  two.report.cases[0].temporal->derivative.values.clear();  // a report of old
  EXPECT_EQ(only_row(two.report, flicker_claim("temporal.derivative")).why,
            "temporal.derivative was not measured for two seeds");
}

// Distances of pairs are not independent: the interval must still hold 1 in 95 % of all cases.
TEST(Claims, TheIntervalOfStaticFlickerHoldsTheTruth) {
  for (const size_t seeds : {3, 4, 8}) {
    size_t held = 0;
    for (uint64_t trial = 0; trial < 1000; ++trial) {
      std::mt19937_64 random(trial);
      std::normal_distribution<> normal;
      std::map<uint64_t, double> logs;
      for (const double sign : {1.0, -1.0}) {
        std::vector<std::vector<double>> images(seeds, std::vector<double>(30));
        for (auto& image : images)
          for (double& value : image) value = normal(random);
        for (size_t s = 0; s < seeds; ++s) {
          double sum = 0;
          for (const auto& other : images)
            for (size_t i = 0; i < other.size(); ++i) sum += std::abs(images[s][i] - other[i]);
          logs[s] += sign * std::log(sum);
        }
      }
      held += mean_of_seeds(logs, true)->ci95.contains(0);
    }
    EXPECT_GE(held, 935u) << seeds;
  }
  EXPECT_FALSE(mean_of_seeds({{0, 1}, {1, 1}}, true));
}

TEST(Claims, TheListThatComesWithTheProgrammeIsSoundAndCitesItsPapers) {
  const auto claims = load_claims();
  EXPECT_GE(claims.size(), 5u);
  MadeReport r(1, 0, 0.1);
  for (const double k : {1.0, 4.0}) {
    MadeCase c = made("mfis", 64, 10 * k);
    c.parameters["K"] = k;
    r.add(c);
  }
  std::vector<TriedClaim> tried;
  for (const PaperClaim& c : claims) {
    EXPECT_TRUE(c.source.starts_with("[MFIS16 §") || c.source.starts_with("[VSGL14 §")) << c.name;
    tried.push_back(try_claim(r.report, c));
  }
  const std::string text = claims_text(r.report, tried, false);
  for (const PaperClaim& c : claims) EXPECT_NE(text.find(c.name + ": "), std::string::npos);
  EXPECT_NE(claims_text(r.report, tried, true).find("| scene | metric | ruling |"), std::string::npos);
}

TEST(Claims, AFaultyListIsRefusedByItsLine) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("claims_test_{}.json", ::getpid());
  write_text(path,
             "{\"claims\": [\n{\"name\": \"x\", \"text\": \"t\", \"source\": \"s\", \"a\": {}, \"b\": {},\n"
             "\"says\": \"fewer\", \"metrics\": [\"rmse\"]}]}");
  try {
    load_claims(path);
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(":3: "), std::string::npos) << e.what();
  }
  std::filesystem::remove(path);
}

TEST(Claims, AListMayNameAnyPassButNoOtherMetric) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("claims_test_{}.json", ::getpid());
  const auto error_of = [&](const std::string& metric) -> std::string {
    write_text(path, R"({"claims": [{"name": "x", "text": "t", "source": "s", "a": {}, "b": {},
      "says": "less", "metrics": [")" +
                         metric + R"("]}]})");
    try {
      return load_claims(path).at(0).metrics.at(0) == metric ? "" : "another metric";
    } catch (const Error& e) {
      return e.what();
    }
  };
  for (const char* metric : {"rmse", "detail", "spikes", "cancellation_rate", "region.rmse", "region.smape",
                             "region.detail", "time:pass:generate.rsm.sum*", "time:pass:shade"})
    EXPECT_EQ(error_of(metric), "");
  for (const char* metric : {"time:pass:", "time:passes:x", "region.flip", "pass:shade"})
    EXPECT_NE(error_of(metric).find(":2: "), std::string::npos) << error_of(metric);
  EXPECT_NE(error_of("region.rmsee").find("did you mean 'region.rmse'"), std::string::npos)
      << error_of("region.rmsee");
  std::filesystem::remove(path);
}

TEST(Claims, NothingOfAReportReachesTheTerminalRaw) {
  MadeReport r(1, 0, 0.3);
  for (const char* method : {"a", "b"}) r.add(made(method, 64, 10, 1, "box\x1b[2J\n"));
  r.report.device.name = "\x1b[2J";
  const std::vector<TriedClaim> tried = {try_claim(r.report, claim_of({{"method", "a"}}, {{"method", "b"}}))};
  for (const bool markdown : {false, true})
    EXPECT_EQ(claims_text(r.report, tried, markdown).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace vsglbench
