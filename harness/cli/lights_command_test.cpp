// `vsglbench lights` as a user meets it.
#include <algorithm>

#include "base/csv.h"
#include "cli/cli_fixture.h"
#include "image/labelled.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class LightsCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    config_["methods"] = {{{"method", "mfis"}}, {{"method", "kmeans2d"}}, {{"method", "vpl"}}};
  }
  Finished lights(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"lights", write_config().string(), "--out", out_.string()};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  fs::path folder(const std::string& method) const {
    return out_ / "cornell" / method / "N=16,rsm=16,vis=exact";
  }
  Json json(const std::string& method) const {
    return Json::parse(read_text(folder(method) / "lights.json"));
  }
};

TEST_F(LightsCommand, WritesPicturesListsAndCoverage) {
  const Finished f = lights({"--seed", "5", "-q"});
  ASSERT_EQ(f.code, 0) << f.err;
  EXPECT_EQ(f.err, "");
  for (const char* method : {"mfis", "kmeans2d", "vpl"}) {
    EXPECT_EQ(read_png(folder(method) / "rsm.png").width, 16u * 16 + 24) << method;
    EXPECT_GT(read_png(folder(method) / "scene.png").width, 900u) << method;
    for (const char* picture : {"rsm.png", "scene.png"}) {
      const Labels said = png_labels(read_text(folder(method) / picture));
      EXPECT_EQ(said.at("case"), std::string("cornell/") + method + "/N=16,rsm=16,vis=exact");
      EXPECT_EQ(said.at("seed"), "5");
      EXPECT_EQ(said.at("scene"), "cornell");
      EXPECT_FALSE(said.at("sceneHash").empty());
    }
    const bool filters = std::string(method) == "mfis";
    EXPECT_EQ(fs::exists(folder(method) / "moments.png"), filters) << method;
    if (filters) {
      EXPECT_EQ(read_png(folder(method) / "moments.png").width, 996u);
    }
    const Json j = json(method);
    expect_numbers(j);
    EXPECT_EQ(j.at("schema"), "vsglbench.lights/2");
    EXPECT_EQ(j.at("case"), std::string("cornell/") + method + "/N=16,rsm=16,vis=exact");
    EXPECT_EQ(j.at("seed"), 5);
    EXPECT_EQ(j.at("config").at("name"), "tiny");
    EXPECT_FALSE(j.at("device").at("name").get<std::string>().empty());
    EXPECT_EQ(j.at("lights").size() + j.at("empty").get<size_t>(), j.at("count").get<size_t>());
    EXPECT_GT(j.at("lights").size(), 0u);
    EXPECT_EQ(j.contains("coverage"), std::string(method) != "vpl");
  }
  EXPECT_TRUE(json("mfis").at("lights")[0].contains("footprint"));
  EXPECT_TRUE(json("mfis").at("lights")[0].contains("edge_share"));
  EXPECT_GT(json("mfis").at("edges").at("lights_on").get<int>() +
                json("mfis").at("edges").at("lights_off").get<int>(),
            0);
  EXPECT_FALSE(json("kmeans2d").contains("edges") || json("vpl").contains("edges"));
  EXPECT_EQ(json("kmeans2d").at("coverage").at("overlap"), 0);
  EXPECT_TRUE(json("vpl").at("lights")[0].contains("brdf"));
  const std::string table = read_text(out_ / "coverage.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
  EXPECT_TRUE(contains(table, "\"cornell/mfis/N=16,rsm=16,vis=exact\",5,ok,16,"));
}

// A row of each seed is that of a run with it alone; pictures and list are of the first.
TEST_F(LightsCommand, SeveralSeedsAreRowsOfCoverage) {
  config_["methods"] = {{{"method", "mfis"}}, {{"method", "vpl"}}};
  const auto rows = [&](const std::vector<std::string>& more) {
    const Finished f = lights(more);
    EXPECT_EQ(f.code, 0) << f.err;
    return parse_csv(read_text(out_ / "coverage.csv"));
  };
  const auto alone = rows({"--seed", "7"});
  const Json last = json("mfis");
  const auto all = rows({"--seed", "5", "--seeds", "3"});
  ASSERT_EQ(alone.size(), 3u);
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[0], alone[0]);
  for (const size_t row : {1, 2, 3, 4, 5, 6}) {
    EXPECT_EQ(all[row].size(), all[0].size());
    EXPECT_EQ(all[row][0], alone[row > 3 ? 2 : 1][0]);
    EXPECT_EQ(all[row][1], std::to_string(5 + (row - 1) % 3));
  }
  EXPECT_EQ(all[3], alone[1]);
  EXPECT_NE(all[1][5], all[3][5]) << "another lattice overlaps otherwise";
  EXPECT_EQ(json("mfis").at("seed"), 5);
  EXPECT_NE(json("mfis").at("lights"), last.at("lights"));
  expect_refused(lights({"--seeds", "0"}), 2, "--seeds");
  expect_refused(lights({"--seed", "4294967295", "--seeds", "2"}), 2, "--seed 4294967295");
}

TEST_F(LightsCommand, CsvOfOneCase) {
  const Finished f = lights({"--case", "*/mfis/*", "--format", "csv"});
  ASSERT_EQ(f.code, 0) << f.err;
  const std::string table = read_text(folder("mfis") / "lights.csv");
  EXPECT_TRUE(contains(table, "index,mean.0,mean.1,mean.2,sigma,power,level,diffuse.axis.0,"));
  EXPECT_FALSE(fs::exists(folder("mfis") / "lights.json") || fs::exists(folder("vpl")));
}

TEST_F(LightsCommand, RefusesWhatItDoesNotKnow) {
  expect_refused(lights({"--case", "cornell/mfsi/N=16,rsm=16,vis=exact"}), 2,
                 "the nearest is 'cornell/mfis/N=16,rsm=16,vis=exact'");
  expect_refused(lights({"--case", "cornell"}), 2, "--case 'cornell' matches none of the 3 cases");
  expect_refused(lights({"--format", "xml"}), 2, "--format");
  expect_refused(run({"lights", "mfis16-fig2"}), 2, "mfis16-fig1");
  write("a-file", "");
  expect_refused(run({"lights", write_config().string(), "--out", (folder_ / "a-file").string()}), 2,
                 "a-file");
}

// `run` reports the same numbers.
TEST_F(LightsCommand, CoverageIsThatOfTheReport) {
  ASSERT_EQ(run_config().code, 0);
  const Report r = report();
  ASSERT_EQ(lights().code, 0);
  ASSERT_EQ(r.cases.size(), 3u);
  for (const CaseResult& c : r.cases) {
    const Json j = json(c.method);
    ASSERT_EQ(c.generate->overlap.has_value(), j.contains("coverage")) << c.id;
    EXPECT_EQ(c.generate->gap.has_value(), j.contains("coverage")) << c.id;
    if (!c.generate->gap) continue;
    EXPECT_EQ(*c.generate->overlap, j.at("coverage").at("overlap").get<double>()) << c.id;
    EXPECT_EQ(*c.generate->gap, j.at("coverage").at("gap").get<double>()) << c.id;
  }
  EXPECT_GT(*r.cases[0].generate->overlap, 0);
}

// As `run --only` does.
TEST_F(LightsCommand, AGlobTakesSeveralCases) {
  const Finished f = lights({"--case", "*/?[fp]*", "--format", "csv"});
  ASSERT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(fs::exists(folder("mfis")) && fs::exists(folder("vpl")));
  EXPECT_FALSE(fs::exists(folder("kmeans2d")));
}

// The rest is drawn.
TEST_F(LightsCommand, ACaseThatFailsCostsItself) {
  config_["N"] = {257, 16};
  config_["methods"] = {{{"method", "mfis"}}};
  const Finished f = lights();
  EXPECT_EQ(f.code, 1) << f.err;
  EXPECT_TRUE(contains(f.out, "failed: N = 257 lights can't be drawn"));
  EXPECT_TRUE(fs::exists(folder("mfis") / "scene.png"));
}

// Each with its first frame; the other methods' pictures are made.
TEST_F(LightsCommand, APluginThatCrashesOrHangsCostsItsOwnCase) {
  config_["methods"] = {{{"method", "vpl"}},
                        {{"method", "crashes"}, {"frame", 1}},
                        {{"method", "hangs"}, {"frame", 1}},
                        {{"method", "mfis"}}};
  config_["time_limit_s"] = 8;
  const fs::path bad = bad_plugins();
  const Finished f = lights({"--plugin-path", bad.string()});
  EXPECT_EQ(f.signal, 0);
  EXPECT_EQ(f.code, 1) << f.err;
  EXPECT_TRUE(contains(f.out, "failed: crashed (signal 11, Segmentation fault) during drawing its lights\n"));
  EXPECT_TRUE(
      contains(f.out, "failed: was stopped after 8 s without a sign of life during drawing its lights\n"));
  for (const char* method : {"vpl", "mfis"}) {
    EXPECT_TRUE(fs::exists(folder(method) / "rsm.png")) << method;
    EXPECT_TRUE(fs::exists(folder(method) / "scene.png")) << method;
    EXPECT_GT(json(method).at("lights").size(), 0u);
  }
  const std::string table = read_text(out_ / "coverage.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  EXPECT_TRUE(contains(table, "\"cornell/crashes/") && contains(table, ",0,failed,"));
}

TEST_F(LightsCommand, ASceneThatIsNotHereIsSkipped) {
  config_["scenes"] = {"sponza", "cornell"};
  config_["methods"] = {{{"method", "mfis"}, {"N", {8, 16}}}};
  const Finished f = lights();
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "skipped: as said above"));
  EXPECT_EQ(f.out.find("scene sponza needs"), f.out.rfind("scene sponza needs"));
  EXPECT_TRUE(fs::exists(folder("mfis") / "scene.png"));
  expect_refused(lights({"--case", "sponza/*"}), 2, "nothing is drawn: ");
}

}  // namespace
}  // namespace vsglbench
