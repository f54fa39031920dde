#include "answer/analysis.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include <unistd.h>

#include "answer/large_report.h"
#include "answer/made_report.h"

namespace vsglbench {
namespace {

// Three on the front; "slow" is beaten by two of them, "like-b" by none for sure.
Report known() {
  MadeReport made(1, 0, 0.1);
  const auto add = [&](const std::string& method, int n, double ms, double error) {
    made.add({.method = method,
              .parameters = {{"N", n}, {"visibility", "none"}},
              .passes = {{"shade", ms}},
              .error = error});
  };
  add("a", 64, 1, 10);
  add("b", 64, 2, 5);
  add("b", 256, 8, 2);
  add("slow", 64, 4, 6);
  add("like-b", 64, 2.001, 5.001);
  return std::move(made.report);
}

Json group(const Json& analysis, const std::string& metric) {
  for (const Json& g : analysis.at("groups")) {
    if (g.at("metric") == metric) return g;
  }
  return nullptr;
}

std::vector<std::string> front_methods(const Json& g) {
  std::vector<std::string> out;
  for (const Json& p : g.at("front")) out.push_back(p.at("case"));
  return out;
}

// What the schema says of a whole report with this analysis.
std::vector<std::string> violations(const Json& analysis) {
  Report r = synthetic_report();
  r.analysis = analysis;
  return schema_violations(to_json(r), report_schema());
}

TEST(Analysis, NamesTheFrontAndWhoBeatsTheOthers) {
  const Json g = group(analysis_of(known()), "smape");
  const std::string end = ",visibility=none";
  EXPECT_EQ(front_methods(g),
            (std::vector<std::string>{"box/a/N=64" + end, "box/b/N=64" + end, "box/b/N=256" + end}));
  std::map<std::string, Json> others;
  for (const Json& o : g.at("others")) others[o.at("case")] = o;
  ASSERT_EQ(others.size(), 2u);
  EXPECT_EQ(others["box/slow/N=64" + end].at("standing"), "dominated");
  EXPECT_EQ(others["box/slow/N=64" + end].at("by"), Json({1}));
  EXPECT_EQ(others["box/like-b/N=64" + end].at("standing"), "ambiguous");
  EXPECT_EQ(g.at("points"), 5);
}

// b from (2, 5) to (8, 2): half way in the logarithm at 4 ms.
TEST(Analysis, ReadsErrorsAtEqualTimeOffEachMethodsOwnFront) {
  const Json g = group(analysis_of(known()), "smape");
  bool met = false;
  for (const Json& step : g.at("equal_time")) {
    EXPECT_FALSE(step.at("errors").contains("slow") && step.at("ms") != 4.0);  // one point: no line
    if (std::abs(step.at("ms").get<double>() - std::sqrt(8.0)) > 1e-6) continue;
    met = true;
    const double t = std::log(std::sqrt(8.0) / 2) / std::log(4.0);
    const double b64 = g.at("front")[1].at("error"), b256 = g.at("front")[2].at("error");
    EXPECT_NEAR(step.at("errors").at("b").get<double>(), b64 * std::pow(b256 / b64, t), 1e-9);
    EXPECT_FALSE(step.at("errors").contains("a"));  // it has no point on the other side
  }
  EXPECT_TRUE(met);
}

TEST(Analysis, PricesTheKnobAndNamesThePassThatPays) {
  const Json g = group(analysis_of(known()), "smape");
  ASSERT_EQ(g.at("knobs").size(), 1u);
  const Json& knob = g.at("knobs")[0];
  EXPECT_EQ(knob.at("key"), "N");
  EXPECT_EQ(knob.at("pass"), "shade");
  EXPECT_NEAR(knob.at("error_ratio").get<double>(), 0.4, 1e-9);
  EXPECT_NEAR(knob.at("time_ratio").get<double>(), 4, 1e-9);
  EXPECT_NEAR(knob.at("pairs")[0].at("ms").get<double>(), 6, 1e-9);
}

TEST(Analysis, IsNullWithoutErrorsAndSaysWhichTimeItCounts) {
  Report r = known();
  EXPECT_EQ(analysis_of(r, "frame").at("time"), "frame");
  for (CaseResult& c : r.cases) c.accuracy.reset();
  EXPECT_TRUE(analysis_of(r).is_null());
  EXPECT_THROW(analysis_of(r, "fram"), Error);
}

TEST(Analysis, ObeysTheReportsSchema) {
  const Json analysis = analysis_of(large_report(300));
  EXPECT_EQ(violations(analysis), std::vector<std::string>());
  EXPECT_EQ(violations(analysis_of(known())), std::vector<std::string>());
  const auto first = [&](const std::function<void(Json&)>& change) {
    Json changed = analysis;
    change(changed["groups"][0]);
    return !violations(changed).empty();
  };
  EXPECT_TRUE(first([](Json& g) { g["others"][0]["standing"] = "beaten"; }));
  EXPECT_TRUE(first([](Json& g) { g["others"][0]["by"][0] = -1; }));
  EXPECT_TRUE(first([](Json& g) { g["front"] = Json::array(); }));
  EXPECT_TRUE(first([](Json& g) { g.erase("equal_error"); }));
  EXPECT_TRUE(first([](Json& g) { g["knobs"][0]["pairs"][0]["error"] = "much"; }));
  EXPECT_TRUE(first([](Json& g) { g["budgets"][0]["parts"][0].erase("missing"); }));
}

TEST(Analysis, StaysInTheFile) {
  Report r = large_report(60);
  r.analysis = analysis_of(r);
  const auto path = std::filesystem::temp_directory_path() / fmt::format("analysis_test_{}.json", ::getpid());
  write_report(path, r);
  EXPECT_EQ(read_report(path).analysis, r.analysis);
  r.analysis = nullptr;  // as in reports of old
  write_report(path, r);
  EXPECT_TRUE(read_report(path).analysis.is_null());
  std::filesystem::remove(path);
}

TEST(Analysis, IsSmallBesideTheReport) {
  Report r = large_report(2000);
  const size_t cases = to_json(r).dump().size();
  EXPECT_LT(analysis_of(r).dump().size(), cases / 4);
}

}  // namespace
}  // namespace vsglbench
