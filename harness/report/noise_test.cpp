#include "report/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "report/synthetic_report.h"

using namespace vsglbench;

namespace {

// The times of both halves, of another pass and of the rest of a frame, ms, the same in every frame.
CaseResult measured(double gbuffer_half, double rsm_half, double shade, double raster) {
  CaseResult c;
  c.id = "cornell/mfis";
  c.scene = "cornell";
  const auto steady = [](double ms) { return summarize(std::vector<double>(8, ms)); };
  c.passes = {{parse_pass_name("gbuffer"), steady(raster)},
              {parse_pass_name("rsm"), steady(raster)},
              {parse_pass_name("generate.gbuffer.sample"), steady(gbuffer_half)},
              {parse_pass_name("generate.rsm.sample"), steady(rsm_half)},
              {parse_pass_name("shade"), steady(shade)}};
  const double frame = gbuffer_half + rsm_half + shade + 2 * raster;
  c.frame = frame_timing(std::vector<double>(8, frame), c.passes);
  c.generate.emplace().total = *generate_time(c.passes);
  return c;
}

double floor_of(const AaPair& pair, const std::string& column) {
  for (const TimeNoise& time : pair.times) {
    if (time.column == column) return time.noise_floor;
  }
  return -1;
}

}  // namespace

// One half takes 1.5 times as long in one of the two: each time shows its own share of that.
TEST(Noise, EachTimeHasItsOwn) {
  const AaPair pair = aa_pair(measured(1, 3, 6, 10), measured(1, 2, 6, 10));
  EXPECT_EQ(pair.scene, "cornell");
  EXPECT_NEAR(floor_of(pair, "generate"), 4.0 / 3 - 1, 1e-12);
  EXPECT_NEAR(floor_of(pair, "generate.gbuffer"), 0, 1e-12);
  EXPECT_NEAR(floor_of(pair, "generate.rsm"), 0.5, 1e-12);
  EXPECT_NEAR(floor_of(pair, "method"), 10.0 / 9 - 1, 1e-12);
  EXPECT_NEAR(floor_of(pair, "frame"), 30.0 / 29 - 1, 1e-12);
  EXPECT_NEAR(floor_of(pair, "fixed"), 0, 1e-12);
  EXPECT_NEAR(floor_of(pair, "shade"), 0, 1e-12);
  EXPECT_EQ(floor_of(pair, "visibility"), -1);  // no shadow maps
  EXPECT_EQ(floor_of(pair, "rays"), -1);        // no rays were traced
  const AaPair twisted = aa_pair(measured(1, 2, 6, 10), measured(1, 3, 6, 10));
  EXPECT_NEAR(floor_of(twisted, "generate.rsm"), 0.5, 1e-12);  // whichever is slower
}

// Sums of parts are those of the whole.
TEST(Noise, AFrameIsTheSumOfItsParts) {
  const CaseResult c = measured(1, 2, 6, 10);
  double sum = 0;
  for (const char* part : {"fixed", "generate", "shade"}) sum += time_of(c, part)->median;
  EXPECT_NEAR(sum, time_of(c, "frame")->median, 1e-12);
  EXPECT_NEAR(time_of(c, "fixed")->median, 20, 1e-12);
  EXPECT_NEAR(time_of(c, "shade")->median, 6, 1e-12);
  EXPECT_FALSE(time_of(c, "importance"));
}

// The passes that count in a time sum to it.
TEST(Noise, ATimeIsTheSumOfThePassesThatCountInIt) {
  const CaseResult c = measured(1, 2, 6, 10);
  for (const std::string& column : time_columns()) {
    double sum = 0;
    for (const PassTiming& p : c.passes) sum += counts_in(column, p.pass) ? p.ms.median : 0;
    const auto time = time_of(c, column);
    EXPECT_NEAR(sum, time ? time->median : 0, 1e-12) << column;
  }
}

// Frame by frame, from the samples.
TEST(Noise, TheTimeOfPassesIsTheSumOfThoseThatMatch) {
  const CaseResult c = synthetic_case("cornell/mfis");
  const auto sum_of = [&](const std::vector<std::string>& names) {
    std::vector<double> sums(4, 0);
    for (const PassTiming& p : c.passes) {
      if (std::ranges::count(names, p.pass.name()) == 0) continue;
      for (size_t i = 0; i < sums.size(); ++i) sums[i] += p.ms.samples[i];
    }
    return sums;
  };
  const std::map<std::string, std::vector<std::string>> meant = {
      {"generate.rsm.mipmap", {"generate.rsm.mipmap"}},
      {"generate.rsm.*", {"generate.rsm.mipmap", "generate.rsm.filter"}},
      {"*.mipmap", {"generate.gbuffer.mipmap", "generate.rsm.mipmap"}},
      {"gbuffer", {"gbuffer"}},
      {"*[st]h*", {"shade"}}};
  for (const auto& [glob, names] : meant) {
    const auto time = time_of_passes(c, glob);
    ASSERT_TRUE(time) << glob;
    EXPECT_EQ(time->samples, sum_of(names)) << glob;
  }
  EXPECT_FALSE(time_of_passes(c, "generate.rsm"));
  EXPECT_FALSE(time_of_passes(c, "importance*"));
}

TEST(Noise, PassesHaveTheNoiseOfTheTimeThatTheyArePartsOf) {
  Report r;
  r.cases = {measured(1, 3, 6, 10), measured(1, 3, 6, 10)};
  r.cases[1].passes.push_back({parse_pass_name("importance.rsm"), summarize({1})});
  r.cases[1].passes.push_back({parse_pass_name("visibility.ism"), summarize({1})});
  const std::map<std::string, std::string> columns = {{"generate.*", "generate"},
                                                      {"*.rsm.sample", "generate"},
                                                      {"importance*", "importance"},
                                                      {"visibility.*", "visibility"},
                                                      {"shade", "shade"},
                                                      {"rsm", "frame"},
                                                      {"*rsm*", "frame"},
                                                      {"nothing", "frame"}};
  for (const auto& [glob, column] : columns) EXPECT_EQ(column_of_passes(r, "cornell", glob), column) << glob;
  EXPECT_EQ(column_of_passes(r, "sponza", "shade"), "frame");
}

TEST(Noise, ATimeThatTheClockDidNotSeeIsLeftOut) {
  const AaPair pair = aa_pair(measured(0, 2, 6, 10), measured(1, 2, 6, 10));
  EXPECT_EQ(floor_of(pair, "generate.gbuffer"), -1);
  EXPECT_NEAR(floor_of(pair, "generate.rsm"), 0, 1e-12);
}

TEST(Noise, EveryNamedTimeIsKnown) {
  const CaseResult c = synthetic_case("cornell/mfis");
  // It has neither shadow maps nor importance passes.
  for (const auto& column : time_columns())
    EXPECT_EQ(time_of(c, column).has_value(), column != "visibility" && column != "importance") << column;
  EXPECT_THROW(time_of(c, "shading"), std::logic_error);
}

TEST(Noise, TheNoisiestTimeOfAllScenesIsNamed) {
  Report r = synthetic_report();
  r.aa.push_back({"ring514", "ring514/mfis", "ring514/mfis#twin", {synthetic_noise("generate.rsm", 0.22)}});
  EXPECT_FALSE(noise_over(r, 0.23));
  const auto line = noise_over(r, 0.05);
  ASSERT_TRUE(line);
  for (const char* part : {"ring514", "'generate.rsm'", "22 %", "over 5 %"})
    EXPECT_NE(line->find(part), std::string::npos) << *line;
  r.aa.pop_back();
  EXPECT_NE(noise_over(r, 0.05)->find("cornell: the time 'generate'"), std::string::npos);
}

TEST(Noise, IsPrintedAsAPercentage) {
  EXPECT_EQ(percent(0.0416), "4.2 %");
  EXPECT_EQ(percent(0.12), "12 %");
  EXPECT_EQ(percent(0.996), "100 %");
  EXPECT_EQ(percent(3.404), "340 %");
}

TEST(Noise, AnUnknownNoiseIsTooMuch) {
  Report r = synthetic_report();
  r.aa.clear();
  EXPECT_NE(noise_over(r, 0.5)->find("cornell"), std::string::npos);
  r.cases.erase(r.cases.begin());  // the failed and skipped ones have no times
  EXPECT_FALSE(noise_over(r, 0.5));
}
