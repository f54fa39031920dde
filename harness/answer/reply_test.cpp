#include "answer/reply.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace vsglbench
