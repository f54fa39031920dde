#include "dashboard/digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "answer/front.h"
#include "base/file.h"
#include "report/synthetic_report.h"

namespace vsglbench {
namespace {

const std::string kReports = std::string(VSGLBENCH_SOURCE_DIR) + "/reports/";

class FrontDigest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    report_ = new Report(read_report_at(kReports + "front-lavapipe"));
    digest_ = new Json(digest_of(*report_, "front-lavapipe"));
  }
  static void TearDownTestSuite() {
    delete digest_;
    delete report_;
  }
  const Report& report() const { return *report_; }
  const Json& digest() const { return *digest_; }

  static Report* report_;
  static Json* digest_;
};
Report* FrontDigest::report_ = nullptr;
Json* FrontDigest::digest_ = nullptr;

TEST_F(FrontDigest, EveryColumnHasAnEntryForEveryCase) {
  const Json& cases = digest().at("cases");
  const size_t n = report().cases.size();
  for (const char* key : {"id", "label", "group", "scene", "method", "status", "message", "passes"})
    EXPECT_EQ(cases.at(key).size(), n) << key;
  for (const char* table : {"times", "errors"}) {
    EXPECT_FALSE(cases.at(table).empty());
    for (const auto& [name, column] : cases.at(table).items()) {
      for (const auto& [part, values] : column.items()) EXPECT_EQ(values.size(), n) << name << "." << part;
    }
  }
  for (const char* table : {"parameters", "extra"}) {
    EXPECT_FALSE(cases.at(table).empty());
    for (const auto& [key, values] : cases.at(table).items()) EXPECT_EQ(values.size(), n) << key;
  }
}

// Against the file itself, not what the programme makes of it.
TEST_F(FrontDigest, FiguresAreThoseOfTheFile) {
  const Json file = Json::parse(read_text(kReports + "front-lavapipe/report.json"));
  const Json& cases = digest().at("cases");
  size_t compared = 0;
  for (size_t i = 0; i < file.at("cases").size(); ++i) {
    const Json& c = file.at("cases")[i];
    EXPECT_EQ(cases.at("id")[i], c.at("id"));
    EXPECT_EQ(digest().at("methods").at(cases.at("method")[i].get<size_t>()), c.at("method"));
    EXPECT_EQ(digest().at("scenes").at(cases.at("scene")[i].get<size_t>()).at("name"), c.at("scene"));
    const Json& ms = c.at("frame").at("method");
    const Json& method = cases.at("times").at("method");
    EXPECT_NEAR(method.at("value")[i].get<double>() / ms.at("median_ms").get<double>(), 1, 1e-6);
    EXPECT_NEAR(method.at("lo")[i].get<double>() / ms.at("ci95_ms")[0].get<double>(), 1, 1e-6);
    EXPECT_NEAR(method.at("hi")[i].get<double>() / ms.at("ci95_ms")[1].get<double>(), 1, 1e-6);
    const Json& rmse = c.at("accuracy").at("rmse");
    if (rmse.value("heavy_tailed", false)) continue;
    ++compared;
    EXPECT_NEAR(cases.at("errors").at("rmse").at("value")[i].get<double>() / rmse.at("value").get<double>(),
                1, 1e-6);
    const Json& hi =
        rmse.contains("ci95") ? rmse.at("ci95")[1] : rmse.at("value");  // one seed alone has none
    EXPECT_NEAR(cases.at("errors").at("rmse").at("hi")[i].get<double>() / hi.get<double>(), 1, 1e-6);
  }
  EXPECT_GT(compared, 300);
}

TEST_F(FrontDigest, PassesAddUpToTheFrame) {
  const Json file = Json::parse(read_text(kReports + "front-lavapipe/report.json"));
  const Json& rows = digest().at("cases").at("passes");
  for (size_t i = 0; i < rows.size(); ++i) {
    double sum = 0, told = 0;
    for (const Json& ms : rows[i].at("ms")) sum += ms.get<double>();
    for (const Json& p : file.at("cases")[i].at("passes")) told += p.at("median_ms").get<double>();
    EXPECT_NEAR(sum / told, 1, 1e-6);
    for (size_t k = 0; k < rows[i].at("pass").size(); ++k) {
      EXPECT_EQ(digest().at("passes").at(rows[i].at("pass")[k].get<size_t>()),
                file.at("cases")[i].at("passes")[k].at("name"));
    }
  }
}

TEST_F(FrontDigest, PassesHaveTheirIntervals) {
  const Json file = Json::parse(read_text(kReports + "front-lavapipe/report.json"));
  const Json& rows = digest().at("cases").at("passes");
  for (size_t i = 0; i < rows.size(); ++i) {
    for (size_t k = 0; k < rows[i].at("pass").size(); ++k) {
      const Json& ci = file.at("cases")[i].at("passes")[k].at("ci95_ms");
      const double ms = file.at("cases")[i].at("passes")[k].at("median_ms").get<double>();
      EXPECT_NEAR(1 - rows[i].at("below")[k].get<double>() / 1e4, ci[0].get<double>() / ms, 0.51e-4);
      EXPECT_NEAR(1 + rows[i].at("above")[k].get<double>() / 1e4, ci[1].get<double>() / ms, 0.51e-4);
    }
  }
}

// The sums over methods give the means that `analyze` wrote.
TEST_F(FrontDigest, KnobsAddUpToTheAnalysis) {
  const Json file = Json::parse(read_text(kReports + "front-lavapipe/report.json"));
  size_t compared = 0;
  for (const Json& g : file.at("analysis").at("groups")) {
    for (const Json& told : g.at("knobs")) {
      for (const Json& k : digest().at("knobs")) {
        const Json& group = digest().at("groups").at(k.at("group").get<size_t>());
        if (k.at("metric") != g.at("metric") || k.at("key") != told.at("key") ||
            group.at("reference") != g.at("reference") ||
            digest().at("scenes").at(group.at("scene").get<size_t>()).at("name") != g.at("scene"))
          continue;
        double pairs = 0, error = 0, time = 0;
        for (const Json& m : k.at("methods")) {
          pairs += m.at("pairs").get<double>();
          error += m.at("error").get<double>();
          time += m.at("times").at("method").get<double>();
        }
        ++compared;
        EXPECT_EQ(pairs, told.at("pairs_in_all").get<double>());
        EXPECT_NEAR(std::exp(error / pairs) / told.at("error_ratio").get<double>(), 1, 1e-6);
        EXPECT_NEAR(std::exp(time / pairs) / told.at("time_ratio").get<double>(), 1, 1e-6);
      }
    }
  }
  EXPECT_EQ(compared, digest().at("knobs").size());
  EXPECT_GT(compared, 50);
}

// Of no case does a pass come before one that stands earlier in the list.
TEST_F(FrontDigest, PassesStandInTheFramesOrder) {
  for (const Json& row : digest().at("cases").at("passes"))
    EXPECT_TRUE(std::ranges::is_sorted(row.at("pass")));
}

TEST_F(FrontDigest, AGroupHoldsCasesOfOneSceneAndReference) {
  const Json& groups = digest().at("groups");
  const Json& of_case = digest().at("cases").at("group");
  EXPECT_EQ(groups.size(), 10);
  for (size_t i = 0; i < report().cases.size(); ++i) {
    const Json& g = groups.at(of_case[i].get<size_t>());
    EXPECT_EQ(g.at("reference"), report().cases[i].accuracy->reference.hash);
    EXPECT_EQ(digest().at("scenes").at(g.at("scene").get<size_t>()).at("name"), report().cases[i].scene);
    EXPECT_EQ(g.at("visibility") == "none", report().cases[i].parameters.at("visibility") == "none");
  }
  EXPECT_NEAR(groups[0].at("floor").at("smape").get<double>(),
              report().cases[0].accuracy->reference.noise_floor_smape, 1e-5);
  EXPECT_GT(groups[0].at("noise").at("method").get<double>(), 0);
}

TEST_F(FrontDigest, BudgetsAreOfTheFrontAndKnobsNameTheirCases) {
  std::vector<std::string> front;
  for (const PointGroup& g : point_groups(report(), {"smape", "method"})) {
    for (const size_t k : front_of(g)) front.push_back(g.points[k].result->id);
  }
  std::vector<std::string> told;
  for (const Json& b : digest().at("budgets")) {
    if (b.at("metric") == "smape") told.push_back(report().cases[b.at("case").get<size_t>()].id);
  }
  std::ranges::sort(front);
  std::ranges::sort(told);
  EXPECT_EQ(told, front);
  EXPECT_FALSE(digest().at("knobs").empty());
  for (const Json& k : digest().at("knobs")) {
    for (const Json& p : k.at("prices")) {
      const CaseResult& before = report().cases[p.at("before").get<size_t>()];
      const CaseResult& after = report().cases[p.at("after").get<size_t>()];
      const auto key = k.at("key").get<std::string>();
      EXPECT_NE(before.parameters.at(key), after.parameters.at(key));
      EXPECT_EQ(before.method, after.method);
    }
  }
}

TEST(Digest, TellsFlickerFailuresAndEffects) {
  Report report;
  report.created = "2026-01-01T00:00:00Z";
  SceneReport scene;
  scene.name = "cornell";
  scene.effects = {{"motion", "nothing moves", false, {"rsm"}, Interval{0.5, 1.5}, 1.0, 64}};
  report.scenes = {scene};
  report.cases = {synthetic_case("cornell/mfis/a"), synthetic_case("cornell/mfis/b")};
  report.cases[1].status = Status::failed;
  report.cases[1].error = CaseError{ErrorKind::timeout, "it was silent"};
  const Json digest = digest_of(report, "x");
  ASSERT_EQ(digest.at("temporal").size(), 2);
  const Json& t = digest.at("temporal")[0];
  EXPECT_EQ(t.at("derivative").at("value"), 0.1);
  EXPECT_EQ(t.at("derivative").at("series"), Json({0.1, 0.1, 0.2}));
  EXPECT_EQ(t.at("detail").at("gain"), 0.95);
  EXPECT_EQ(digest.at("cases").at("status"), Json({"ok", "failed"}));
  EXPECT_EQ(digest.at("cases").at("message")[1], "it was silent");
  EXPECT_EQ(digest.at("cases").at("group"), Json({0, -1}));
  const Json& effect = digest.at("scenes")[0].at("effects")[0];
  EXPECT_EQ(effect.at("ms"), 1.0);
  EXPECT_EQ(effect.at("ms_ci95"), Json({0.5, 1.5}));
  EXPECT_EQ(effect.at("needed"), false);
}

TEST(Digest, PapersThatAreNoneAreRefused) {
  EXPECT_THROW(
      digest_papers(Json({{"schema", "vsglbench.papers/1"}, {"exhibits", {{{"trials", {1}}}}}}), "x.json"),
      Error);
  EXPECT_THROW(digest_papers(Json::array(), "x.json"), Error);
  EXPECT_THROW(digest_papers(Json({{"schema", "other/1"}, {"exhibits", Json::array()}}), "x.json"), Error);
  const Json papers = Json::parse(read_text(kReports + "papers/lavapipe/papers.json"));
  const Json claims = digest_papers(papers, "papers.json");
  size_t holds = 0, told = 0;
  for (const Json& e : papers.at("exhibits")) {
    for (const Json& trial : e.at("trials")) told += trial.at("ruling") == "holds";
  }
  for (const Json& c : claims) holds += c.at("ruling") == "holds";
  EXPECT_EQ(holds, told);
  EXPECT_GT(holds, 0);
}

}  // namespace
}  // namespace vsglbench
