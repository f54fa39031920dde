#include "answer/claims.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "answer/claims_fixture.h"
#include "base/file.h"

namespace vsglbench {
namespace {

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
