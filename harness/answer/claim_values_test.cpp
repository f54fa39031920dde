// What claims compare beside errors and the time of a method: how lights lie, passes, seeds' images, flicker.
#include "answer/claim_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "answer/claim_pairs.h"
#include "answer/claims_fixture.h"

namespace vsglbench {
namespace {

// Seeds that lack it are not compared, nor, where nothing says how many there may be, those that have none.
TEST(ClaimValues, HowTheLightsLieIsComparedSeedBySeed) {
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

// A set without a too large kernel counts as one with half of one.
TEST(ClaimValues, NoTooLargeKernelIsFewerThanSome) {
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

// Of an RSM of 64² texels: a set without a gap has half a texel of one, so that no seed is left out; two
// without any tell nothing.
TEST(ClaimValues, NoGapIsASmallerOneThanSome) {
  constexpr double kHalf = 0.5 / 4096;
  for (const char* metric : {"overlap", "gap", "pdf_overlap", "pdf_gap"}) {
    const auto row_with = [&](const std::vector<double>& of_a, double of_b) {
      MadeReport r(1, 0, 0, 16, of_a.size());
      for (const char* method : {"a", "b"}) {
        MadeCase c = made(method, 64, 10);
        c.parameters["rsm"] = 64;
        CaseResult& added = r.add(c);
        for (size_t s = 0; s < of_a.size(); ++s) {
          const double value = added.method == "a" ? of_a[s] : of_b;
          added.seeds[s].coverage = Coverage{value, value, value, value};
        }
      }
      PaperClaim claim = claim_of({{"method", "a"}}, {{"method", "b"}});
      claim.metrics = {metric};
      return only_row(r.report, claim);
    };
    EXPECT_EQ(row_with({0, 0, 0}, 0.1).ruling, Ruling::holds) << metric;
    EXPECT_NEAR(row_with({0, 0, 0}, 0.1).ratio, kHalf / (0.1 + kHalf), 1e-9) << metric;
    // A seed that has none is the one that tells most: the mean is over all three.
    EXPECT_NEAR(std::log(row_with({0, 0.1, 0.1}, 0.1).ratio), std::log(kHalf / (0.1 + kHalf)) / 3, 1e-9)
        << metric;
    EXPECT_EQ(row_with({0, 0, 0}, 0).ruling, Ruling::not_run) << metric;
    EXPECT_EQ(row_with({0, 0, 0}, 0).why, fmt::format("{} is 0 in every seed of both sides", metric));
  }
}

// Two sets with the same too large kernels are alike; two without any tell nothing.
TEST(ClaimValues, NothingBesideNothingIsNoRatio) {
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
  EXPECT_EQ(row_with(0).why, "kernel_over is 0 in every seed of both sides");
  EXPECT_EQ(row_with(0.125).ruling, Ruling::does_not_hold);
}

// Of a, one pass takes longer and another less, so that the sum of the half is the same.
TEST(ClaimValues, SinglePassesAreCompared) {
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
TEST(ClaimValues, WhatASeedsImageShowsIsComparedSeedBySeed) {
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
TEST(ClaimValues, SpikesAreComparedWithHalfAPixelMore) {
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
TEST(ClaimValues, FlickerIsComparedSeedBySeedAtEqualK) {
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
TEST(ClaimValues, FlickerWithoutEffectIsUndecided) {
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
TEST(ClaimValues, StepsCompareEachValueWithTheNextSmaller) {
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

TEST(ClaimValues, SaysWhatOfMotionIsMissing) {
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
TEST(ClaimValues, TheIntervalOfStaticFlickerHoldsTheTruth) {
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

}  // namespace
}  // namespace vsglbench
