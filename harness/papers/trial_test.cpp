// Trials of claims, and what a change of one is called.
#include "papers/trial.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "papers/flips.h"

using namespace vsglbench;

namespace {

ClaimTrial made(const std::string& claim, Ruling ruling, double ratio = 0.5) {
  ClaimTrial t{.exhibit = "fig",
               .claim = claim,
               .text = "A cuts B",
               .source = "[P §5]",
               .how = "a beside b",
               .place = "box",
               .metric = "rmse",
               .ruling = ruling};
  t.ratio = ratio;
  t.ci95 = Interval{0.9 * ratio, 1.1 * ratio};
  return t;
}

Json papers(const std::vector<ClaimTrial>& trials, const std::string& scale = "quick") {
  Json exhibit = {{"name", "fig"}, {"scale", scale}, {"trials", Json::array()}};
  for (const ClaimTrial& t : trials) exhibit["trials"].push_back(to_json(t));
  return {{"exhibits", Json::array({exhibit})}};
}

TEST(ClaimTrial, SurvivesJson) {
  const ClaimTrial t = made("x", Ruling::does_not_hold, 1.5), back = trial_from_json(to_json(t));
  EXPECT_EQ(to_json(back), to_json(t));
  EXPECT_EQ(back.ruling, Ruling::does_not_hold);
  EXPECT_EQ(back.ci95->hi, 1.1 * 1.5);
  Json wrong = to_json(t);
  wrong["ruling"] = "perhaps";
  EXPECT_THROW(trial_from_json(wrong), Error);
}

TEST(ClaimTrial, EveryRulingHasAName) {
  for (const Ruling r :
       {Ruling::holds, Ruling::does_not_hold, Ruling::in_part, Ruling::undecided, Ruling::not_run})
    EXPECT_EQ(ruling_named(std::string(name(r))), r);
}

TEST(Flips, TellWhatNoLongerHolds) {
  const auto found = flips(papers({made("x", Ruling::holds), made("y", Ruling::holds)}),
                           papers({made("x", Ruling::does_not_hold, 2), made("y", Ruling::holds)}))
                         .changed;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].lost);
  const std::string text = flip_text(found[0]);
  EXPECT_NE(text.find("[P §5]: no longer holds: A cuts B"), std::string::npos) << text;
  EXPECT_NE(text.find("was holds: 0.5 [0.45, 0.55], is does not hold: 2 [1.8, 2.2]"), std::string::npos)
      << text;
}

TEST(Flips, InPartIsNoLongerWhatHeld) {
  EXPECT_TRUE(
      flips(papers({made("x", Ruling::holds)}), papers({made("x", Ruling::in_part)})).changed[0].lost);
}

TEST(Flips, WhatNoiseLeavesOpenIsAChangeAndNoFlip) {
  const auto found = flips(papers({made("x", Ruling::holds), made("y", Ruling::undecided)}),
                           papers({made("x", Ruling::undecided), made("y", Ruling::holds)}))
                         .changed;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_FALSE(found[0].lost);
  EXPECT_FALSE(found[1].lost);
  EXPECT_EQ(flip_text(found[0]).find("no longer holds"), std::string::npos);
}

TEST(Flips, OnlyTrialsOfOneScaleAreCompared) {
  EXPECT_EQ(
      flips(papers({made("x", Ruling::holds)}, "quick"), papers({made("x", Ruling::does_not_hold)}, "paper"))
          .compared,
      0u);
  const Flips other = flips(papers({made("x", Ruling::holds)}), papers({made("z", Ruling::does_not_hold)}));
  EXPECT_EQ(other.compared, 0u);
  EXPECT_EQ(other.vanished, 1u);
}

TEST(ClaimTrial, OfAFigureKeepsWhatItFound) {
  DrawnFigure figure;
  figure.claims = {{"first", "[P 1]", Finding::holds, "1 < 2"},
                   {"second", "[P 2]", Finding::does_not_hold, "3 > 2"},
                   {"third", "[P 3]", Finding::undecided, "noise"}};
  Exhibit e;
  e.name = "fig1";
  e.figure = "sgl22-1";
  const auto trials = trials_of(figure, e);
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].ruling, Ruling::holds);
  EXPECT_EQ(trials[1].ruling, Ruling::does_not_hold);
  EXPECT_EQ(trials[2].ruling, Ruling::undecided);
  EXPECT_EQ(trials[1].claim, "sgl22-1/2");
}

Json size(const char* method, int kernels, int dispatches, int lines) {
  return {{"method", method},
          {"kernels", kernels},
          {"dispatches", {{"rsm", dispatches}, {"gbuffer", 1}}},
          {"own_lines", lines},
          {"shared_lines", 0}};
}

TEST(ClaimTrial, OfCodeSizeComparesCounts) {
  Exhibit e;
  e.name = "tab3";
  const auto ruling = [&](const Json& sizes, const std::string& claim) {
    for (const ClaimTrial& t : trials_of_code_size(sizes, e)) {
      if (t.claim == "code-size/" + claim) return t.ruling;
    }
    throw std::out_of_range(claim);
  };
  const Json as_published = {size("fis", 2, 2, 222), size("mfis", 2, 2, 232), size("kmeans2d", 9, 39, 1143),
                             size("kmeans3d", 9, 39, 1172)};
  for (const ClaimTrial& t : trials_of_code_size(as_published, e))
    EXPECT_EQ(t.ruling, Ruling::holds) << t.claim;
  const Json otherwise = {size("fis", 2, 2, 222), size("mfis", 3, 9, 300), size("kmeans2d", 3, 9, 900),
                          size("kmeans3d", 9, 39, 1300)};
  EXPECT_EQ(ruling(otherwise, "mfis-kernels"), Ruling::does_not_hold);
  EXPECT_EQ(ruling(otherwise, "mfis-lines"), Ruling::does_not_hold);
  EXPECT_EQ(ruling(otherwise, "kmeans2d-kernels"), Ruling::does_not_hold);
  EXPECT_EQ(ruling(otherwise, "kmeans2d-dispatches"), Ruling::does_not_hold);
  EXPECT_EQ(ruling(otherwise, "kmeans2d-lines"), Ruling::does_not_hold);
  EXPECT_EQ(ruling(otherwise, "kmeans3d-lines"), Ruling::holds);
}

}  // namespace
