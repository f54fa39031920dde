#include "answer/chart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "answer/charts.h"
#include "answer/front.h"
#include "answer/large_report.h"
#include "answer/made_report.h"
#include "base/file.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

MadeCase made(const std::string& method, int n, double ms, double error) {
  return {.scene = "hall:north",
          .method = method,
          .parameters = {{"N", n}, {"K", 1.0}, {"visibility", "none"}},
          .passes = {{"gbuffer", 9}, {"generate.rsm.sort", 0.25 * ms}, {"shade", 0.75 * ms}},
          .error = error};
}

class ChartTest : public ::testing::Test {
 protected:
  ChartTest() : folder_(fs::temp_directory_path() / fmt::format("chart_test_{}", ::getpid())) {}
  ~ChartTest() override { fs::remove_all(folder_); }

  static Report small() {
    MadeReport r(1, 0.01, 0.1);
    for (const int n : {64, 256}) {
      r.add(made("vpl", n, n / 64.0, 640.0 / n));
      r.add(made("it's_one|more", n, n / 32.0, 500.0 / n));
    }
    return std::move(r.report);
  }
  std::vector<std::string> names(const DrawnCharts& drawn) const {
    std::vector<std::string> out;
    for (const fs::path& p : drawn.paths) out.push_back(p.filename().string());
    return out;
  }
  fs::path folder_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ChartTest, DrawsEveryKindAndNamesItsFiles) {
  MadeReport r(1, 0.01, 0.1);
  r.report = small();
  MadeCase texels = made("all-texels", 1, 9, 1);
  texels.parameters = {{"K", 1.0}, {"shading", "exact"}, {"visibility", "none"}};
  r.add(texels);
  const DrawnCharts drawn = draw_charts(r.report, {folder_, {}, "", {}});
  EXPECT_EQ(names(drawn), (std::vector<std::string>{
                              "hall@north-none-front-smape.svg", "hall@north-none-front-smape.png",
                              "hall@north-none-passes-smape.svg", "hall@north-none-passes-smape.png",
                              "hall@north-none-budget-smape.svg", "hall@north-none-budget-smape.png",
                              "hall@north-none-over-N-smape.svg", "hall@north-none-over-N-smape.png"}));
  for (const fs::path& p : drawn.paths) EXPECT_GT(fs::file_size(p), 4000u) << p;
  const std::string front = read_text(drawn.paths[0]);
  for (const char* text : {"hall:north, without occlusion", "SMAPE / %", "method time / ms", "made", ">vpl<",
                           "it’s_one|more", ">front<", "all passes but the raster"})
    EXPECT_TRUE(contains(front, text)) << text;
  EXPECT_TRUE(contains(read_text(drawn.paths[2]), "generate.rsm.sort"));
  EXPECT_FALSE(contains(read_text(drawn.paths[2]), ">gbuffer<"));  // no part of the method's time
}

TEST_F(ChartTest, APointAloneIsDrawn) {
  MadeReport r(1, 0, 0.1);
  r.add(made("vpl", 64, 1, 10));
  EXPECT_EQ(draw_charts(r.report, {folder_, {}, "", {}}).paths.size(), 4u);  // nothing is swept
}

TEST_F(ChartTest, WithoutPointsItSaysSo) {
  Report r = small();
  for (CaseResult& c : r.cases) c.accuracy.reset();
  try {
    draw_charts(r, {folder_, {}, "", {}});
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_TRUE(
        contains(e.what(), "nothing to draw: no case of this report has both SMAPE and the time 'method'"));
  }
  EXPECT_THROW(draw_charts(small(), {folder_, {}, "hall", {}}), Error);
  EXPECT_THROW(draw_charts(small(), {folder_, {}, "", {"*/nothing/*"}}), Error);
  EXPECT_FALSE(fs::exists(folder_));
}

std::string front_script(const Report& r, const std::string& metric = "smape") {
  const AnswerOptions options{metric, "method"};
  const auto groups = point_groups(r, options);
  return chart_script(front_chart(ChartSource(r, groups[0], options)), PlotFormat::svg);
}

TEST_F(ChartTest, ErrorsThatALogarithmCannotShowAreSaid) {
  Report r = small();
  EXPECT_FALSE(contains(front_script(r), "lower edge"));
  MetricResult& exact = r.cases[0].accuracy->smape;
  exact.value = 0;
  exact.ci95 = Interval{0, 0};
  EXPECT_TRUE(contains(front_script(r), "cases with an error of 0"));
  r.cases[1].accuracy->smape.ci95 = Interval{-3, 20};
  EXPECT_TRUE(contains(front_script(r), "are cut there: 1"));
  r.cases[2].seeds[0].errors.smape *= 100;
  EXPECT_TRUE(contains(front_script(r), "from the least seed to the largest: 1"));
  Gnuplot().run(front_script(r));
  for (CaseResult& c : r.cases) c.accuracy->smape.value = 0;
  Gnuplot().run(front_script(r));
}

// Every point of the data, with its intervals, is what the report says.
TEST_F(ChartTest, PointsAreTheReports) {
  const Report r = small();
  const auto groups = point_groups(r);
  const std::string script = front_script(r);
  for (const Point& p : groups[0].points) {
    EXPECT_TRUE(
        contains(script, fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", p.ms.value, p.error.value,
                                     p.ms.ci95.lo, p.ms.ci95.hi, p.error.ci95.lo, p.error.ci95.hi)));
  }
}

TEST_F(ChartTest, EveryTimeHasWords) {
  for (const std::string& time : time_columns()) EXPECT_FALSE(time_words(time).empty()) << time;
}

TEST_F(ChartTest, TheHostsRaysAreNoPasses) {
  const Report r = large_report(40);
  const AnswerOptions options{"smape", "rays"};
  const auto groups = point_groups(r, options);
  ASSERT_FALSE(groups.empty());
  std::vector<std::string> remarks;
  for (const Chart& c : charts_of(ChartSource(r, groups[0], options), {0}, &remarks))
    EXPECT_NE(c.kind, "passes");
  ASSERT_EQ(remarks.size(), 2u);  // and all-texels is missing
  EXPECT_TRUE(contains(remarks[0], "is no sum of passes"));
}

TEST_F(ChartTest, AMethodLooksTheSameOnEveryChartAndNoTwoAlike) {
  std::set<std::string> styles;
  for (size_t i = 0; i < 84; ++i) styles.insert(point_style(i));
  EXPECT_EQ(styles.size(), 84u);
}

TEST_F(ChartTest, ManyPointsStayReadable) {
  const Report r = large_report(3000);
  const std::string front = front_script(r);
  EXPECT_TRUE(contains(front, "bars, 95 % intervals"));
  EXPECT_LT(Gnuplot().run(front).size(), 3u << 20);
  const AnswerOptions options;
  const auto groups = point_groups(r, options);
  const auto series = series_chart(ChartSource(r, groups[0], options), "N");
  EXPECT_TRUE(contains(chart_script(*series, PlotFormat::svg), "of every method those with the least error"));
}

TEST_F(ChartTest, BudgetSaysWhatWasNotRun) {
  const Report r = small();
  const AnswerOptions options;
  const auto groups = point_groups(r, options);
  std::vector<std::string> missing;
  EXPECT_FALSE(budget_chart(ChartSource(r, groups[0], options), front_of(groups[0]), &missing));
  EXPECT_EQ(missing, std::vector<std::string>{"all-texels, shading exact, visibility none"});
  const DrawnCharts drawn = draw_charts(r, {folder_, {}, "", {}});
  ASSERT_EQ(drawn.remarks.size(), 1u);
  EXPECT_TRUE(contains(drawn.remarks[0], "no budget; it needs all-texels, shading exact, visibility none"));

  // With SG lobes missing, what they and the clusters cost together can be told.
  MadeReport some(1, 0, 0);
  MadeCase texels = made("all-texels", 1, 9, 4), vsgls = made("fis", 64, 1, 10);
  texels.parameters = {{"K", 1.0}, {"shading", "exact"}, {"visibility", "none"}};
  vsgls.parameters["shading"] = "vsgl16";
  some.add(texels);
  some.add(vsgls);
  const auto with = point_groups(some.report, options);
  const auto chart = budget_chart(ChartSource(some.report, with[0], options), {0}, &missing);
  ASSERT_TRUE(chart);
  const std::string script = chart_script(*chart, PlotFormat::svg);
  for (const char* text :
       {"SG lobes + clustering", "'+4'", "'+6'", "all-texels, shading vsgl16, visibility none"})
    EXPECT_TRUE(contains(script, text)) << text << "\n" << script;
}

// Two series of one method have marks and names of their own, as long as there is room.
TEST_F(ChartTest, TheFrontTellsSeriesOfOneMethodApart) {
  const auto marks = [](const std::string& script, const std::string& name) {
    const size_t title = script.find("title '" + name), at = script.rfind("pointtype ", title);
    return title == std::string::npos ? "none" : script.substr(at, script.find(" pointsize", at) - at);
  };
  MadeReport r(1, 0.01, 0.1);
  for (const int n : {64, 256}) {
    for (const double k : {1.0, 4.0}) {
      MadeCase c = made("mfis", n, n * k, 100 / k);
      c.parameters["K"] = k;
      r.add(c);
    }
    r.add(made("vpl", n, n, 500));
  }
  const std::string script = front_script(r.report);
  const std::string one = marks(script, "mfis K=1.0"), four = marks(script, "mfis K=4.0");
  EXPECT_NE(one, "none") << script;
  EXPECT_NE(four, "none");
  EXPECT_NE(one, four);
  EXPECT_EQ(one.substr(one.find("lc ")), four.substr(four.find("lc ")));  // the method's colour
  EXPECT_FALSE(contains(script, "a mark is a method"));
  Gnuplot().run(script);
  const std::string many = front_script(large_report(300));
  EXPECT_TRUE(contains(many, "a mark is a method"));
  EXPECT_TRUE(contains(many, "title 'vpl'"));
}

}  // namespace
}  // namespace vsglbench
