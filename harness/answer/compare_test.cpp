#include "answer/compare.h"

#include <gtest/gtest.h>

#include "answer/made_report.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

struct Plant {
  std::string pass;  // slowed down, in every case
  double factor = 1;
  std::string method;  // that gets `bias`, and `all`
  double bias = 0;
  double all = 1;    // of every pass of the method
  std::string only;  // the method whose `pass` it is; empty: every one's
};

// Twelve cases as a GPU measures them, 1 % of noise a frame, and an A/A pair.
Report measured(uint64_t seed, const Plant& plant = {}) {
  MadeReport made(seed, 0.01, 0.05, 24);
  for (const char* method : {"fis", "mfis", "cut"}) {
    for (const int n : {64, 128, 256, 512}) {
      MadeCase c{.method = method,
                 .parameters = {{"N", n}},
                 .passes = {{"gbuffer", 2},
                            {"generate.rsm.sample", 0.3},
                            {"importance.rsm", 1},
                            {"shade", n / 100.0}},
                 .error = 1000.0 / n};
      if (c.passes.contains(plant.pass) && (plant.only.empty() || plant.only == method))
        c.passes[plant.pass] *= plant.factor;
      if (plant.method == method) {
        c.bias = plant.bias;
        for (auto& [pass, ms] : c.passes) ms *= plant.all;
      }
      made.add(c);
    }
  }
  MadeReport again(seed + 1000, 0.01, 0.05, 24);
  MadeCase first{
      .parameters = {{"N", 64}},
      .passes = {{"gbuffer", 2}, {"generate.rsm.sample", 0.3}, {"importance.rsm", 1}, {"shade", 0.64}},
      .error = 1000.0 / 64};
  if (first.passes.contains(plant.pass) && plant.only.empty()) first.passes[plant.pass] *= plant.factor;
  for (auto& [pass, ms] : first.passes) ms *= plant.method == first.method ? plant.all : 1;
  const CaseResult twin = again.add(first);
  made.report.aa = {aa_pair(made.report.cases.front(), twin)};
  return made.report;
}

template <class T>
size_t not_null(const std::vector<T>& changes) {
  return static_cast<size_t>(std::ranges::count_if(
      changes, [](const T& c) { return c.change != Change::same && c.change != Change::ambiguous; }));
}

TEST(Compare, AReportIsNoWorseThanItself) {
  const Report report = measured(1);
  const Comparison c = compare_reports(report, report);
  EXPECT_EQ(c.exit_code(), 0) << comparison_text(c, false);
  EXPECT_EQ(not_null(c.passes) + not_null(c.times) + not_null(c.errors), 0u);
  EXPECT_EQ(c.cases, 12u);
}

// 40 runs of the same program: at most one says anything.
TEST(Compare, FortyNullComparisonsFindNothing) {
  size_t said = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const Comparison c = compare_reports(measured(seed), measured(seed + 100));
    const size_t found =
        not_null(c.passes) + not_null(c.method_passes) + not_null(c.times) + not_null(c.errors);
    said += found > 0;
    if (found > 0) printf("%s", comparison_text(c, false).c_str());
  }
  EXPECT_LE(said, 1u);
}

TEST(Compare, ASlowerPassIsNamedAndNoOther) {
  const Comparison c = compare_reports(measured(1), measured(2, {.pass = "importance.rsm", .factor = 1.05}));
  for (const TimeChange& t : c.passes)
    EXPECT_EQ(t.change == Change::slower, t.time == "importance.rsm") << t.time << " " << t.ratio.value;
  EXPECT_EQ(c.exit_code(), 4);
  EXPECT_NE(comparison_text(c, false).find("slower  pass importance.rsm: +"), std::string::npos);
  const Comparison back =
      compare_reports(measured(2, {.pass = "importance.rsm", .factor = 1.05}), measured(1));
  EXPECT_NE(comparison_text(back, true).find("| faster | pass importance.rsm | -"), std::string::npos);
}

TEST(Compare, ABiasOfOneMethodIsNamed) {
  const Comparison c = compare_reports(measured(1), measured(2, {.method = "cut", .bias = 0.02}));
  size_t worse = 0;
  for (const ErrorChange& e : c.errors) {
    const bool planted = e.metric == "bias" && e.case_id.find("/cut/") != std::string::npos;
    EXPECT_EQ(e.change == Change::worse, planted) << e.case_id << " " << e.metric;
    worse += planted;
  }
  EXPECT_EQ(worse, 4u);
  EXPECT_EQ(c.exit_code(), 4);
}

TEST(Compare, RefusesWhatIsNotComparable) {
  const Report base = measured(1);
  Report other = base;
  other.cases[3].accuracy->reference.hash = "ffff";
  EXPECT_NE(compare_reports(base, other).refusal.find("references differ"), std::string::npos);
  other = base;
  other.cases[3].accuracy->smape.formula = "smape-0-100";
  EXPECT_NE(compare_reports(base, other).refusal.find("two formulas"), std::string::npos);
  other = base;
  other.device.name = "another";
  const Comparison c = compare_reports(base, other);
  EXPECT_NE(c.refusal.find("devices differ"), std::string::npos);
  EXPECT_EQ(c.exit_code(), 5);
  EXPECT_EQ(compare_reports(base, other, {.other_device = true}).refusal, "");
  EXPECT_NE(compare_reports(base, Report{}).refusal, "");
}

// `run --set` and `--skip-effects` change a case and not its name.
TEST(Compare, RefusesCasesOfOneNameAndOtherSettings) {
  Report base = measured(1), other = base;
  base.cases[3].parameters["skip_effects"] = "";
  other.cases[3].parameters["skip_effects"] = "occlusion";
  const Comparison c = compare_reports(base, other);
  EXPECT_NE(c.refusal.find(base.cases[3].id + ": the settings differ, skip_effects \"\" and \"occlusion\""),
            std::string::npos)
      << c.refusal;
  EXPECT_EQ(c.exit_code(), 5);
  EXPECT_EQ(compare_reports(base, other, {.other_settings = true}).refusal, "");
  base.cases[3].parameters.erase("skip_effects");  // a report of before there was such a key
  EXPECT_EQ(compare_reports(base, other).refusal, "");
}

// Another machine, half as fast in everything: within it, methods stand to each other as before.
TEST(Compare, RatiosHoldOnAnyMachine) {
  Report slow = measured(2);
  slow.device.name = "half as fast";
  for (CaseResult& c : slow.cases) {
    std::vector<double> span(c.frame->span.samples.size(), 0);
    for (PassTiming& p : c.passes) {
      for (double& ms : p.ms.samples) ms *= 2;
      p.ms = summarize(p.ms.samples);
      for (size_t k = 0; k < span.size(); ++k) span[k] += p.ms.samples[k];
    }
    c.frame = frame_timing(span, c.passes);
  }
  const Comparison same = compare_reports(measured(1), slow, {.ratios = true});
  EXPECT_EQ(not_null(same.times) + not_null(same.passes), 0u) << comparison_text(same, false);
  EXPECT_NE(same.exit_code(), 4);
}

// The importance is most of the scene's first case, and of no other.
TEST(Compare, RatiosNameASlowerPassAndNoOther) {
  const Report planted = measured(2, {.pass = "importance.rsm", .factor = 1.05});
  const Comparison c = compare_reports(measured(1), planted, {.ratios = true});
  for (const TimeChange& t : c.passes) {
    EXPECT_EQ(t.change == Change::slower, t.time == "importance.rsm") << t.time << " " << t.ratio.value;
    EXPECT_NE(t.change, Change::faster) << t.time << " " << t.ratio.value;
    EXPECT_NEAR(t.ratio.value, t.time == "importance.rsm" ? 1.05 : 1, 0.005) << t.time;
  }
  for (const TimeChange& t : c.times) EXPECT_NE(t.change, Change::faster) << t.case_id;
  EXPECT_EQ(c.exit_code(), 4);
  const Comparison back = compare_reports(planted, measured(1), {.ratios = true});
  for (const TimeChange& t : back.times) EXPECT_NE(t.change, Change::slower) << t.case_id;
  EXPECT_EQ(back.exit_code(), 0) << comparison_text(back, false);
}

TEST(Compare, RatiosNameASlowerMethodAndNoOther) {
  for (const char* method : {"fis", "cut"}) {  // with and without the first case
    const Comparison c =
        compare_reports(measured(1), measured(2, {.method = method, .all = 1.1}), {.ratios = true});
    for (const TimeChange& t : c.times) {
      const bool is_planted = t.case_id.find(fmt::format("/{}/", method)) != std::string::npos;
      EXPECT_EQ(t.change == Change::slower, is_planted) << t.case_id << " " << t.ratio.value;
      EXPECT_NE(t.change, Change::faster) << t.case_id << " " << t.ratio.value;
    }
    EXPECT_EQ(c.times.size(), 12u);
    EXPECT_EQ(c.exit_code(), 4);
  }
}

TEST(Compare, FortyNullComparisonsOfRatiosFindNothing) {
  size_t said = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const Comparison c = compare_reports(measured(seed), measured(seed + 100), {.ratios = true});
    said += not_null(c.passes) + not_null(c.method_passes) + not_null(c.times) > 0;
  }
  EXPECT_LE(said, 1u);
}

// Its interval begins within the noise and ends beyond it, on the side of faster.
TEST(Compare, WhatMayBeFasterIsNoDoubt) {
  Comparison c;
  c.passes = {{"", "", "", "shade", {0.97, {0.94, 1.0}}, 0.02, 0.9, Change::ambiguous}};
  EXPECT_EQ(c.exit_code(), 0);
  c.passes[0].ratio.ci95.hi = 1.03;
  EXPECT_EQ(c.exit_code(), 5);
}

// Nor does it make anything unclear that is clear without it, of the same noise.
TEST(Compare, AnImprovementIsNamedAndNoFailure) {
  size_t clear = 0;
  for (const bool ratios : {false, true}) {
    for (const char* only : {"", "cut"}) {
      for (uint64_t seed = 1; seed <= 10; ++seed) {
        const Plant plant{.pass = "shade", .factor = 0.9, .only = only};
        const Comparison c = compare_reports(measured(seed), measured(seed + 100, plant), {.ratios = ratios});
        const Comparison null = compare_reports(measured(seed), measured(seed + 100), {.ratios = ratios});
        EXPECT_EQ(c.exit_code(), null.exit_code()) << comparison_text(c, false);
        clear += c.exit_code() == 0;
        const std::string line = only[0] ? "faster  pass shade of cut: -" : "faster  pass shade: -";
        EXPECT_NE(comparison_text(c, false).find(line), std::string::npos) << comparison_text(c, false);
      }
    }
  }
  EXPECT_GE(clear, 36u);  // of 40
}

TEST(Compare, APassOfOneMethodAloneIsNamedAsThat) {
  for (const bool ratios : {false, true}) {
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      const Plant plant{.pass = "shade", .factor = 1.05, .only = "cut"};
      const Comparison c = compare_reports(measured(seed), measured(seed + 100, plant), {.ratios = ratios});
      EXPECT_EQ(c.exit_code(), 4);
      for (const TimeChange& t : c.method_passes)
        EXPECT_EQ(t.change == Change::slower, t.time == "shade" && t.method == "cut")
            << t.time << " " << t.method;
      EXPECT_EQ(not_null(c.passes), 0u) << comparison_text(c, false);
      EXPECT_NE(comparison_text(c, false).find("slower  pass shade of cut: +"), std::string::npos);
    }
  }
}

// One case a method, as in a small gate: the frames tell.
TEST(Compare, APassOfAMethodWithOneCaseIsNamed) {
  const auto one_each = [](Report r) {
    std::erase_if(r.cases, [](const CaseResult& c) { return c.parameters["N"] != 64; });
    return r;
  };
  const Plant plant{.pass = "shade", .factor = 1.08, .only = "cut"};
  const Comparison c = compare_reports(one_each(measured(1)), one_each(measured(2, plant)), {.ratios = true});
  EXPECT_EQ(c.cases, 3u);
  for (const TimeChange& t : c.method_passes)
    EXPECT_EQ(t.change == Change::slower, t.time == "shade" && t.method == "cut")
        << t.time << " " << t.method;
  EXPECT_EQ(c.exit_code(), 4);
}

TEST(Compare, NoiseThatIsNotKnownIsNotZero) {
  Report base = measured(1), now = measured(2, {.pass = "shade", .factor = 1.3});
  base.aa.clear();
  now.aa.clear();
  const std::string text = comparison_text(compare_reports(base, now), false);
  EXPECT_NE(text.find("noise not known"), std::string::npos) << text;
  EXPECT_EQ(text.find("noise 0"), std::string::npos) << text;
}

TEST(Compare, ACaseThatFailsNowIsARegression) {
  const Report base = measured(1);
  Report now = base;
  now.cases[5].status = Status::failed;
  const Comparison c = compare_reports(base, now);
  EXPECT_EQ(c.exit_code(), 4);
  EXPECT_EQ(c.broken, std::vector<std::string>{base.cases[5].id});
}

TEST(Compare, ByteEqualKernelsMakeTimesNoise) {
  Report base = measured(1), now = measured(2, {.pass = "shade", .factor = 1.3});
  base.kernels = now.kernels = "00112233";
  const Comparison c = compare_reports(base, now);
  EXPECT_TRUE(c.byte_equal);
  EXPECT_EQ(c.exit_code(), 0);
  EXPECT_NE(comparison_text(c, false).find("noise"), std::string::npos);
}

TEST(Compare, NothingOfAReportReachesTheTerminalRaw) {
  Report base = measured(1);
  for (CaseResult& c : base.cases) c.id += "\x1b[2J\n";
  Report now = measured(2, {.pass = "shade", .factor = 1.5});
  for (CaseResult& c : now.cases) c.id += "\x1b[2J\n";
  now.cases[3].status = Status::failed;
  for (const bool markdown : {false, true}) {
    const std::string text = comparison_text(compare_reports(base, now), markdown);
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    EXPECT_EQ(text.find("\n:"), std::string::npos) << text;
    EXPECT_NE(text.find("[2J"), std::string::npos) << text;
  }
  now.device.name = "\x1b[2J";
  EXPECT_EQ(comparison_text(compare_reports(base, now), false).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace vsglbench
