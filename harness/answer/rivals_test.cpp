#include "answer/rivals.h"

#include <gtest/gtest.h>

#include "answer/made_report.h"
#include "base/error.h"

namespace vsglbench {
namespace {

MadeCase at(const std::string& method, int n, double ms, double error, const char* shading = nullptr) {
  MadeCase c{.method = method,
             .parameters = {{"N", n}, {"visibility", "none"}},
             .passes = {{"shade", ms}},
             .error = error};
  if (shading) c.parameters["shading"] = shading;
  return c;
}

TEST(Rivals, StandingsAndErrorsAtEqualTime) {
  MadeReport made(1, 0.001, 0.001);
  // The papers' staircase in log-log: error 40 at 10 ms, 10 at 40 ms, so 20 at 20 ms.
  made.add(at("mfis", 64, 10, 40, "vsgl16"));
  made.add(at("mfis", 256, 40, 10, "vsgl16"));
  made.add(at("mfis", 512, 20, 1000, "filtered"));  // no paper's shading: not on that staircase
  made.add(at("vpl", 64, 18, 12));
  made.add(at("cut", 64, 20, 16, "filtered"));     // dominated by vpl; 16 of the papers' 20
  made.add(at("cut", 16, 5, 50, "filtered"));      // not dominated; no paper's point is as cheap
  made.add(at("cut", 256, 30, 13.2, "filtered"));  // dominated, too; 13.2 of the papers' 13.33
  const auto all = rivalries(made.report, {.method = "cut", .metrics = {"smape"}});
  ASSERT_EQ(all.size(), 1u);
  const Rivalry& r = all[0];
  EXPECT_EQ(r.scene, "box");
  EXPECT_EQ(r.visibility, "none");
  ASSERT_EQ(r.dominated.size(), 2u);
  EXPECT_TRUE(r.dominated[0].starts_with("N=64,") && r.dominated[0].find(" by vpl N=64") != std::string::npos)
      << r.dominated[0];
  EXPECT_EQ(r.undominated, 1u);
  ASSERT_EQ(r.at_equal_time.size(), 2u);
  EXPECT_NEAR(r.at_equal_time[0], 0.8, 0.01);
  EXPECT_NEAR(r.at_equal_time[1], 13.2 / (400.0 / 30), 0.01);
  const std::string table = rivalry_table(all);
  EXPECT_NE(table.find("| box | none | 1 / 0 / 2 | 0.89 [0.80, 0.99] of 2 |"), std::string::npos) << table;
  EXPECT_NE(table.find("* box, none, smape: N=64"), std::string::npos) << table;
}

// Its own points don't count as rivals.
TEST(Rivals, AMethodDoesNotDominateItself) {
  MadeReport made(1, 0.001, 0.001);
  made.add(at("cut", 64, 10, 10));
  made.add(at("cut", 256, 20, 20));
  made.add(at("vpl", 64, 30, 5));
  const auto all = rivalries(made.report, {.method = "cut", .metrics = {"smape"}});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].undominated, 2u);
  EXPECT_NE(rivalry_table(all).find("No point is dominated."), std::string::npos);
}

TEST(Rivals, AnUnknownMethodIsNamed) {
  MadeReport made(1, 0.001, 0.001);
  made.add(at("cut", 64, 10, 10));
  try {
    rivalries(made.report, {.method = "cute", .metrics = {"smape"}});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'cut'"), std::string::npos) << e.what();
  }
}

TEST(Rivals, OfOneSceneAndVisibilityOnly) {
  MadeReport made(1, 0.001, 0.001);
  made.add(at("cut", 64, 10, 10));
  RivalQuestion question{.method = "cut", .metrics = {"smape"}, .scene = "box", .visibility = "none"};
  EXPECT_EQ(rivalries(made.report, question).size(), 1u);
  question.visibility = "full";
  EXPECT_THROW(rivalries(made.report, question), Error);
  question.visibility.clear();
  question.scene = "bx";
  EXPECT_THROW(rivalries(made.report, question), Error);
}

// Two references of one scene and visibility are two rows.
TEST(Rivals, EachReferenceHasItsRow) {
  const auto row = [](const char* reference, const char* metric) {
    return Rivalry{
        .scene = "box", .visibility = "none", .reference = reference, .metric = metric, .undominated = 1};
  };
  const std::string table =
      rivalry_table({row("a", "rmse"), row("a", "flip"), row("b", "rmse"), row("b", "flip")});
  EXPECT_NE(table.find("| box | none | 1 / 0 / 0 | 1 / 0 / 0 | - |\n"
                       "| box | none | 1 / 0 / 0 | 1 / 0 / 0 | - |\n"),
            std::string::npos)
      << table;
}

}  // namespace
}  // namespace vsglbench
