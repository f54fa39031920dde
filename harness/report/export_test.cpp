#include "report/export.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "report/synthetic_report.h"

namespace vsglbench {
namespace {

Report report() {
  Report r;
  r.cases = {synthetic_case("cornell/mfis/N=256"),
             synthetic_failure("cornell/vpl/N=256", Status::failed, "no")};
  return r;
}

TEST(Export, BencherHasNanosecondsAndBounds) {
  const Report r = report();
  const Json json = export_report(r, "bencher");
  ASSERT_EQ(json.size(), 1u) << "failed cases have no numbers";
  const Json& c = json.at("cornell/mfis/N=256");
  EXPECT_DOUBLE_EQ(c.at("latency").at("value").get<double>(), 1e6 * r.cases[0].frame->method->median);
  EXPECT_LE(c.at("latency").at("lower_value"), c.at("latency").at("value"));
  EXPECT_DOUBLE_EQ(c.at("smape").at("value").get<double>(), *r.cases[0].accuracy->smape.value);
}

TEST(Export, GithubActionIsAListOfWhatIsBetterSmaller) {
  const Json json = export_report(report(), "github-action");
  ASSERT_FALSE(json.empty());
  for (const Json& entry : json) {
    EXPECT_TRUE(entry.at("unit") == "ms" || entry.at("unit") == "%");
    EXPECT_TRUE(entry.at("value").is_number());
    EXPECT_TRUE(entry.at("name").get<std::string>().starts_with("cornell/mfis/N=256 "));
    EXPECT_TRUE(entry.at("range").is_string());
  }
}

TEST(Export, GoogleBenchmarkHasItsKeys) {
  const Json json = export_report(report(), "google-benchmark");
  EXPECT_TRUE(json.at("context").contains("date"));
  ASSERT_EQ(json.at("benchmarks").size(), 1u);
  const Json& run = json["benchmarks"][0];
  for (const char* key : {"name", "run_name", "run_type", "iterations", "real_time", "cpu_time", "time_unit"})
    EXPECT_TRUE(run.contains(key)) << key;
  EXPECT_EQ(run.at("time_unit"), "ms");
}

TEST(Export, AnUnknownFormatIsMetWithTheNearest) {
  try {
    export_report(report(), "benchr");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'bencher'"), std::string::npos);
  }
}

}  // namespace
}  // namespace vsglbench
