#include "answer/reply.h"

#include <gtest/gtest.h>

#include <tuple>

#include "answer/made_report.h"

namespace vsglbench {
namespace {

// error = 100 / ms for fis, half of that for cut.
Report sweep() {
  MadeReport made(1, 0, 0);
  for (const char* method : {"fis", "cut"}) {
    for (const int n : {64, 256, 1024}) {
      const double ms = n / 64.0;
      made.add({.method = method,
                .parameters = {{"N", n}, {"visibility", "exact"}},
                .passes = {{"gbuffer", 50}, {"shade", ms}},
                .error = (method[0] == 'c' ? 50 : 100) / ms});
    }
  }
  return made.report;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Reply, NamesTheCheapestThatReachesAnError) {
  Question q;
  ask_error("smape<=13", &q);
  const std::string text = reply(sweep(), q);
  EXPECT_TRUE(has(text, "for SMAPE at most 13 %, take cut N=256: SMAPE 12.5 %")) << text;
  EXPECT_TRUE(has(text, "in 4 [")) << text;
  EXPECT_TRUE(has(text, "Halving that error, to 6.2")) << text;
  EXPECT_TRUE(has(text, "2 times as long")) << text;
  EXPECT_TRUE(has(text, "fis N=1024")) << text;  // its own cheapest
  EXPECT_TRUE(has(text, "4.00")) << text;        // × time
}

TEST(Reply, WithoutAQuestionNamesTheLeastErrorAndWhatIsCheaper) {
  const std::string text = reply(sweep(), {});
  EXPECT_TRUE(has(text, "the least SMAPE is 3.12 % [")) << text;
  EXPECT_TRUE(has(text, "by cut N=1024, in 16 [")) << text;
  EXPECT_TRUE(has(text, "No cheaper case is within twice that error.")) << text;
  MadeReport more(1, 0, 0);
  more.report = sweep();
  more.add({.method = "cut",
            .parameters = {{"N", 512}, {"visibility", "exact"}},
            .passes = {{"gbuffer", 50}, {"shade", 4}},
            .error = 6});
  EXPECT_TRUE(has(reply(more.report, {}),
                  "Within twice that error cut N=512 is the cheapest: 6 % in 4 ms, 0.25 times as long."))
      << reply(more.report, {});
}

// Median and range are no interval of 95 %, and say so.
TEST(Reply, OfHeavyTailedSeedsItHasMedianAndRange) {
  Report r = sweep();
  Question q;
  ask_error("smape<=60", &q);
  EXPECT_FALSE(has(reply(r, q), "median")) << reply(r, q);
  for (CaseResult& c : r.cases) {
    if (c.method == "cut" && c.parameters.at("N") == 64) c.seeds[0].errors.smape *= 20;
  }
  const std::string text = reply(r, q);
  EXPECT_TRUE(has(text, "SMAPE 50 % [50 … 1000] (median and range of seeds)")) << text;
  EXPECT_TRUE(has(text, "[ … ]: median and range of seeds, not 95 %, where the largest is over 10 times"))
      << text;
}

TEST(Reply, ATimeOfFewFramesHasNoInterval) {
  MadeReport made(1, 0, 0, 2);
  made.add(
      {.parameters = {{"N", 64}, {"visibility", "exact"}}, .passes = {{"gbuffer", 50}, {"shade", 1640}}});
  EXPECT_TRUE(has(reply(made.report, {}), "in 1640 (2 frames) ms")) << reply(made.report, {});
}

TEST(Reply, NamesTheBestWithinATime) {
  Question q;
  ask_time("5ms", &q);
  const std::string text = reply(sweep(), q);
  EXPECT_TRUE(has(text, "for at most 5 ms, take cut N=256")) << text;
  EXPECT_TRUE(has(text, "fis N=256")) << text;
}

// mfis is 4 ms cheaper than cut and far less exact; the A/A pair differs by more than that.
Report near_in_time(double noise) {
  MadeReport made(1, 0, 0);
  const Json parameters = {{"N", 64}, {"visibility", "exact"}};
  made.add({.method = "mfis", .parameters = parameters, .passes = {{"shade", 785}}, .error = 27.9});
  made.add({.method = "cut", .parameters = parameters, .passes = {{"shade", 789}}, .error = 17.1});
  made.add({.method = "vpl", .parameters = parameters, .passes = {{"shade", 2000}}, .error = 14});
  if (noise > 0) made.report.aa = {{"box", "", "", {{"method", {}, noise}}}};
  return made.report;
}

TEST(Reply, OfThoseAsCheapTheMostExactIsNamed) {
  Question q;
  ask_error("smape<=30", &q);
  const std::string text = reply(near_in_time(0.02), q);
  EXPECT_TRUE(has(text, "take cut: SMAPE 17.1 %")) << text;
  EXPECT_TRUE(has(text, "in time not to be told apart: mfis")) << text;
  EXPECT_TRUE(has(reply(near_in_time(0.02), {}), "Within twice that error cut is the cheapest"));
  EXPECT_TRUE(has(reply(near_in_time(2), {}), "No case that is surely cheaper is within twice that error."));
  // 4 ms of 785 are a difference where nothing is noisy: 0.51 %.
  MadeReport quiet(1, 0, 0);
  quiet.report = near_in_time(0.0001);
  EXPECT_TRUE(has(reply(quiet.report, q), "take mfis: SMAPE 27.9 %")) << reply(quiet.report, q);
}

TEST(Reply, OfThoseAsExactTheCheapestIsNamed) {
  MadeReport made(1, 0, 0);
  const auto add = [&](const char* method, double ms, double error, double spread) {
    CaseResult& c = made.add({.method = method,
                              .parameters = {{"N", 64}, {"visibility", "exact"}},
                              .passes = {{"shade", ms}},
                              .error = error});
    for (size_t s = 0; s < c.seeds.size(); ++s) c.seeds[s].errors.smape *= 1 + (s % 2 ? spread : -spread);
    c.accuracy = accuracy_over_seeds(c.seeds, c.accuracy->reference);
  };
  add("vsl", 90, 10, 0.2);
  add("cut", 10, 10.5, 0);
  add("fis", 5, 30, 0);
  add("mfis", 8, 40, 1 - 1e-6);  // of seeds that far apart nothing can be told, but fis is before it in both
  Question q;
  ask_time("100ms", &q);
  const std::string text = reply(made.report, q);
  EXPECT_TRUE(has(text, "take cut: SMAPE 10.5 %")) << text;
  EXPECT_TRUE(has(text, "in error not to be told apart: mfis, vsl")) << text;
  const std::string open = reply(made.report, {});
  EXPECT_TRUE(has(open, "for the least SMAPE, take cut: 10.5 % [")) << open;
  EXPECT_TRUE(has(open, "10 % [8.")) << open;
  EXPECT_TRUE(has(open, "by vsl in 90 [90, 90] ms can't be told from that")) << open;
}

TEST(Reply, SaysWhatIsUnderTheReferencesFloor) {
  Report report = near_in_time(0);
  for (CaseResult& c : report.cases) c.accuracy->reference.noise_floor_smape = 20;
  Question q;
  ask_error("smape<=20", &q);
  const std::string text = reply(report, q);
  EXPECT_TRUE(has(text, "SMAPE 17.1 % [17.1, 17.1] ≤ floor of 20 % in 789")) << text;
  EXPECT_TRUE(has(text, "17.1 [17.1, 17.1] ≤ floor ")) << text;
  EXPECT_TRUE(has(text, "floor: the reference's own noise, 20 %")) << text;
  EXPECT_TRUE(has(reply(report, {}), "the least SMAPE is 14 % [14, 14] ≤ floor of 20 % by vpl"));
  EXPECT_FALSE(has(reply(near_in_time(0), q), "floor"));
}

TEST(Reply, NamesBothEndsOfWhatHalvingCosts) {
  Question q;
  ask_error("smape<=27", &q);
  MadeReport made(1, 0, 0);
  for (const auto& [method, ms, error] :
       {std::tuple{"fis", 2.0, 25.0}, {"cut", 4.0, 16.0}, {"vsl", 16.0, 4.0}})
    made.add({.method = method,
              .parameters = {{"N", 64}, {"visibility", "exact"}},
              .passes = {{"shade", ms}},
              .error = error});
  EXPECT_TRUE(has(reply(made.report, q), "times as long (between cut, 16 % in 4 ms, and vsl, 4 % in 16 ms)."))
      << reply(made.report, q);
}

TEST(Reply, NumbersHaveNoExponent) {
  EXPECT_EQ(significant(1640, 3), "1640");
  EXPECT_EQ(significant(164.4, 2), "164");
  EXPECT_EQ(significant(999.7, 3), "1000");
  EXPECT_EQ(significant(0.00164, 3), "0.00164");
  EXPECT_EQ(significant(16.44, 3), "16.4");
}

TEST(Reply, SaysThatAllCasesFailed) {
  Report report = near_in_time(0);
  for (CaseResult& c : report.cases) c.status = Status::failed;
  try {
    reply(report, {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_TRUE(has(e.what(), "3 of 3 failed")) << e.what();
  }
}

TEST(Reply, SaysWhatComesNearestWhereNothingFits) {
  Question q;
  ask_error("smape <= 0.5 %", &q);
  const std::string text = reply(sweep(), q);
  EXPECT_TRUE(has(text, "no case has SMAPE at most 0.5 %; the nearest is cut N=1024")) << text;
}

TEST(Reply, RefusesWhatIsNoQuestion) {
  Question q;
  for (const char* bad :
       {"5", "smape=5", "smape<=", "smape<=-1", "smape<=five", "smap<=5", "bias<=1", "<=5", "smape<=5x"})
    EXPECT_THROW(ask_error(bad, &q), Error) << bad;
  for (const char* bad : {"", "ms", "-2ms", "2s", "nan", "inf", "0"})
    EXPECT_THROW(ask_time(bad, &q), Error) << bad;
  ask_time("2 ms", &q);
  EXPECT_DOUBLE_EQ(*q.ms, 2);
  q.scene = "boxx";
  try {
    reply(sweep(), q);
    FAIL();
  } catch (const Error& e) {
    EXPECT_TRUE(has(e.what(), "did you mean 'box'")) << e.what();
  }
}

TEST(Reply, NothingOfAReportReachesTheTerminalRaw) {
  Report report = near_in_time(0);
  report.device.name = "a\x1b[31m\ndevice";
  for (CaseResult& c : report.cases) c.scene = "box\x1b]0;title\a";
  for (CaseResult& c : report.cases) c.method += "\x1b[2J";
  Question q;
  for (int asked = 0; asked < 2; ++asked) {
    const std::string text = reply(report, q);
    EXPECT_EQ(text.find_first_of("\x1b\a"), std::string::npos) << text;
    EXPECT_TRUE(has(text, "a\\x1b[31m device")) << text;
    ask_error("smape<=30", &q);
  }
}

}  // namespace
}  // namespace vsglbench
