#include "dashboard/history.h"

#include <gtest/gtest.h>

#include "answer/made_report.h"

namespace vsglbench {
namespace {

// A report of two cases whose shading takes these ms.
Report made(uint64_t seed, double fis_ms, double mfis_ms, double error = 10) {
  MadeReport m(seed, 0.004, 0.02, 64);
  m.add({"box", "fis", {{"N", 64}, {"visibility", "none"}}, {{"rsm", 1}, {"shade", fis_ms}}, error});
  m.add({"box", "mfis", {{"N", 64}, {"visibility", "none"}}, {{"rsm", 1}, {"shade", mfis_ms}}, 8});
  m.report.kernels = "k" + std::to_string(seed);  // else differences of time are noise
  m.report.created = "2026-01-" + std::to_string(10 + seed) + "T00:00:00Z";
  m.report.aa = {{"box", m.report.cases[0].id, m.report.cases[0].id, {{"method", {1, {0.99, 1.01}}, 0.01}}}};
  return m.report;
}

Json history_of(const std::vector<Report>& reports) {
  History history;
  for (const Report& r : reports) history.add(r, r.created);
  std::vector<std::string> notes;
  return history.json(&notes);
}

const Json* change_of(const Json& history, size_t report, size_t series) {
  for (const Json& c : history.at("changes")) {
    if (c.at("report") == report && c.at("series") == series) return &c;
  }
  return nullptr;
}

TEST(History, FindsAStepAndNothingElse) {
  std::vector<Report> reports;
  for (uint64_t i = 0; i < 8; ++i) reports.push_back(made(i, i < 4 ? 10 : 10.6, i < 6 ? 20 : 18));
  const Json history = history_of(reports);
  ASSERT_EQ(history.at("reports").size(), 8);
  ASSERT_EQ(history.at("series").size(), 2);
  const Json* slower = change_of(history, 4, 0);
  ASSERT_NE(slower, nullptr);
  EXPECT_EQ(slower->at("change"), "slower");
  EXPECT_NEAR(slower->at("ratio").get<double>(), 1.06, 0.01);
  EXPECT_EQ(slower->at("persistent"), true);
  const Json* faster = change_of(history, 6, 1);
  ASSERT_NE(faster, nullptr);
  EXPECT_EQ(faster->at("change"), "faster");
  EXPECT_EQ(faster->at("persistent"), true);
  EXPECT_EQ(history.at("changes").size(), 2);
  const Json& values = history.at("series")[0].at("values").at("method");
  EXPECT_EQ(values.at("value").size(), 8);
  EXPECT_NEAR(values.at("value")[5].get<double>() / values.at("value")[0].get<double>(), 1.06, 0.01);
  EXPECT_LE(values.at("lo")[0].get<double>(), values.at("value")[0].get<double>());
  EXPECT_EQ(history.at("series")[0].at("noise").at("method"), 0.01);
}

TEST(History, AStepThatGoesAwayIsNotPersistentAndTheNewestHasNotStoodYet) {
  std::vector<Report> reports;
  for (uint64_t i = 0; i < 6; ++i) reports.push_back(made(i, i == 3 ? 11 : 10, i == 5 ? 22 : 20));
  const Json history = history_of(reports);
  ASSERT_NE(change_of(history, 3, 0), nullptr);
  EXPECT_EQ(change_of(history, 3, 0)->at("persistent"), false);
  ASSERT_NE(change_of(history, 5, 1), nullptr);
  EXPECT_EQ(change_of(history, 5, 1)->at("persistent"), false);
}

// 48 reports in which mfis becomes slower by `drift` in all, 0.15 % a report at most.
std::vector<Report> drifting(double drift, bool same_kernels = false) {
  std::vector<Report> reports;
  for (uint64_t i = 0; i < 48; ++i) {
    reports.push_back(made(i, 10, 20 * (1 + drift * double(i) / 47)));
    if (same_kernels) reports.back().kernels = "same";
  }
  return reports;
}

TEST(History, WhatCreepsIsMarkedThoughNoStepOfItIs) {
  const Json history = history_of(drifting(0.07));
  ASSERT_EQ(history.at("changes").size(), 1) << history.at("changes").dump();
  const Json& creep = history.at("changes")[0];
  EXPECT_EQ(creep.at("series"), 1);
  EXPECT_EQ(creep.at("column"), "method");
  EXPECT_EQ(creep.at("change"), "slower");
  EXPECT_EQ(creep.at("persistent"), true);
  // The ends' middles are the reports 7 and 40.
  EXPECT_NEAR(creep.at("ratio").get<double>(), 1 + 0.07 * 33 / 47, 0.006);
  EXPECT_NEAR(creep.at("report").get<double>(), 7 + 33 / 4.0, 4);
  EXPECT_NEAR(creep.at("until").get<double>(), 7 + 33 * 3 / 4.0, 4);
}

TEST(History, NoiseDoesNotCreepNorDoesAMachineUnderTheSameKernels) {
  EXPECT_TRUE(history_of(drifting(0)).at("changes").empty());
  EXPECT_TRUE(history_of(drifting(0.07, true)).at("changes").empty());
}

TEST(History, ACreepingStretchEndsAtAStep) {
  std::vector<Report> reports = drifting(0.07);
  for (uint64_t i = 24; i < 48; ++i) reports[i] = made(i, 10, 30 * (1 + 0.07 * double(i) / 47));
  const Json history = history_of(reports);
  // Either side is too short for a verdict: the step is all that is told.
  ASSERT_EQ(history.at("changes").size(), 1) << history.at("changes").dump();
  EXPECT_EQ(history.at("changes")[0].at("report"), 24);
  EXPECT_TRUE(history.at("changes")[0].at("until").is_null());
}

TEST(History, ErrorsStepToo) {
  std::vector<Report> reports;
  for (uint64_t i = 0; i < 4; ++i) reports.push_back(made(i, 10, 20, i < 2 ? 10 : 9));
  const Json history = history_of(reports);
  const Json* better = change_of(history, 2, 0);
  ASSERT_NE(better, nullptr);
  EXPECT_EQ(better->at("change"), "better");
  EXPECT_NEAR(better->at("ratio").get<double>(), 0.9, 1e-4);
}

TEST(History, ACaseThatIsAbsentHasAGapAndARefusalIsTold) {
  std::vector<Report> reports = {made(0, 10, 20), made(1, 10, 20), made(2, 10, 20)};
  reports[1].cases.pop_back();
  reports[2].device.name = "another";
  const Json history = history_of(reports);
  EXPECT_TRUE(history.at("series")[1].at("values").at("method").at("value")[1].is_null());
  EXPECT_FALSE(history.at("series")[1].at("values").at("method").at("value")[2].is_null());
  EXPECT_EQ(history.at("reports")[1].at("refusal"), "");
  EXPECT_NE(history.at("reports")[2].at("refusal"), "");
}

}  // namespace
}  // namespace vsglbench
