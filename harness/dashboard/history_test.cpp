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
