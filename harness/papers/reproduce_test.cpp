// An exhibit made from nothing to its page, small.
#include "papers/reproduce.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "image/png.h"
#include "papers/page.h"
#include "run/scene_images.h"

using namespace vsglbench;
namespace fs = std::filesystem;

namespace {

class Reproduce : public ::testing::Test {
 protected:
  Reproduce() {
    static int serial = 0;
    folder_ = fs::temp_directory_path() / fmt::format("vsglbench-papers-{}-{}", ::getpid(), serial++);
    fs::create_directories(folder_);
    write_text(folder_ / "tiny.json", R"({
      "name": "tiny", "scenes": ["cornell"],
      "methods": [{"method": "fis"}, {"method": "mfis"}, {"method": "vpl"}],
      "frame": {"width": 400, "height": 400}, "rsm": 64, "N": 16, "importance_lights": 16, "visibility": "none",
      "seeds": 3, "reference": {"samples": 16}, "timing": {"min_samples": 2, "max_samples": 2, "warmup": 0},
      "scales": {"quick": {"frame": {"width": 40, "height": 30}}}})");
    exhibit_.name = "tiny-fig";
    exhibit_.source = "[P Fig. 1]";
    exhibit_.title = "Tiny";
    exhibit_.runs = {(folder_ / "tiny.json").string()};
    exhibit_.columns = {"rmse"};
    exhibit_.claims = {"mfis-costs-nothing"};
    exhibit_.table = {{"FIS",
                       "GTX",
                       "*/fis/*",
                       "*",
                       {{"Generation", "1.0", {"generate.*"}, false}, {"Shade", "2.0", {"shade"}, false}}}};
    exhibit_.sheet = {{exhibit_.runs[0], "*", {"reference", "indirect", "error"}, {}}};
  }
  ~Reproduce() override { fs::remove_all(folder_); }
  WorkOptions options() const {
    WorkOptions o;
    o.scale = "quick";
    o.out = folder_ / "out";
    o.argv = {"vsglbench", "reproduce"};
    return o;
  }
  Json make(WorkOptions o) const {
    PapersWork work(std::move(o));
    return reproduce_exhibit(exhibit_, load_claims(), &work, "quick", folder_);
  }
  fs::path folder_;
  Exhibit exhibit_;
};

TEST_F(Reproduce, GoesFromConfigToPage) {
  Json made = make(options());
  ASSERT_TRUE(made.at("problems").empty()) << made.at("problems").dump();
  ASSERT_EQ(made.at("tables").size(), 1u);
  EXPECT_GT(made["tables"][0]["rows"][0]["value"].get<double>(), 0);
  ASSERT_EQ(made.at("trials").size(), 1u);
  EXPECT_NE(made["trials"][0]["ruling"], "not run") << made["trials"].dump();
  const Bitmap sheet = read_png(folder_ / "tiny-fig.png");
  EXPECT_GT(sheet.width, 4u * 400);  // a reference and three cases
  const Json papers = {{"device", made["device"]}, {"host", made["host"]}, {"exhibits", Json::array({made})}};
  const std::string page = papers_page(papers);
  EXPECT_NE(page.find("| FIS | Generation | 1.0 |"), std::string::npos) << page;
  EXPECT_NE(page.find("mfis-costs-nothing"), std::string::npos);
}

TEST_F(Reproduce, WhatIsFinishedStands) {
  const Json first = make(options()), second = make(options());
  EXPECT_EQ(first["measured"], second["measured"]);
  EXPECT_EQ(first["trials"], second["trials"]);
  WorkOptions anew = options();
  anew.force = true;
  EXPECT_NE(make(anew)["tables"], first["tables"]);  // times of other frames
}

// A scene that is not on this machine is tried again, and costs the others nothing.
TEST_F(Reproduce, WhatIsFinishedStandsBesideWhatIsNotThere) {
  Json config = JsonDocument::load(folder_ / "tiny.json", ErrorKind::config).root();
  config["scenes"] = {"cornell", "conference"};
  write_text(folder_ / "tiny.json", config.dump());
  WorkOptions o = options();
  o.assets = folder_;
  const Json first = make(o), second = make(o);
  ASSERT_EQ(first["problems"].size(), 1u) << first["problems"].dump();  // its three cases alike
  EXPECT_NE(first["problems"][0].get<std::string>().find(" and 2 more: "), std::string::npos);
  EXPECT_EQ(first["measured"][0]["created"], second["measured"][0]["created"]);
  EXPECT_EQ(first["tables"], second["tables"]);
}

TEST_F(Reproduce, AsItIsTakesWhatAnotherProgrammeMade) {
  const Json first = make(options());
  const fs::path file = folder_ / "out" / "tiny" / "report.json";
  Report report = read_report(file);
  report.git.commit = std::string(40, '0');
  write_report(file, report);
  WorkOptions as_is = options();
  as_is.as_is = true;
  EXPECT_EQ(make(as_is)["tables"], first["tables"]);
  EXPECT_EQ(make(as_is)["measured"][0]["commit"], std::string(40, '0'));
  EXPECT_NE(make(options())["measured"][0]["commit"], std::string(40, '0'));  // measured anew
}

TEST_F(Reproduce, AsItIsLeavesWhatIsOfAnotherConfigNow) {
  make(options());
  Json config = JsonDocument::load(folder_ / "tiny.json", ErrorKind::config).root();
  config["N"] = 8;
  write_text(folder_ / "tiny.json", config.dump());
  WorkOptions as_is = options();
  as_is.as_is = true;
  EXPECT_TRUE(make(as_is).at("problems").empty());
  const Report report = read_report(folder_ / "out" / "tiny" / "report.json");
  EXPECT_EQ(report.cases.at(0).parameters.at("N"), 8);
}

// Only the case whose picture it was is measured again.
TEST_F(Reproduce, LostPicturesAreMadeAgain) {
  make(options());
  const fs::path file = folder_ / "out" / "tiny" / "report.json";
  const Report before = read_report(file);
  const std::string lost = preview_of(before.cases.at(0).images.at("indirect"));
  fs::remove(folder_ / "out" / "tiny" / lost);
  WorkOptions as_is = options();
  as_is.as_is = true;
  const Json kept = make(as_is);
  ASSERT_EQ(kept.at("problems").size(), 1u) << kept.at("problems").dump();
  EXPECT_NE(kept["problems"][0].get<std::string>().find("--force"), std::string::npos);
  EXPECT_EQ(kept.at("sheet"), "tiny-fig.png");  // with the others
  EXPECT_TRUE(make(options()).at("problems").empty());
  EXPECT_TRUE(fs::exists(folder_ / "out" / "tiny" / lost));
  const Report after = read_report(file);
  EXPECT_EQ(after.created, before.created);
  EXPECT_EQ(after.cases.at(1).frame->span.samples, before.cases.at(1).frame->span.samples);
}

TEST_F(Reproduce, LostPicturesOfLightsAreDrawnAgain) {
  exhibit_.runs.clear();
  exhibit_.lights = {(folder_ / "tiny.json").string()};
  exhibit_.light_cases = {"*/mfis/*"};
  exhibit_.table.clear();
  exhibit_.sheet = {{exhibit_.lights[0] + "-lights", "*", {}, {"*rsm.png", "*absent.png"}}};
  const Json first = make(options());
  ASSERT_EQ(first.at("problems").size(), 1u) << first.at("problems").dump();
  EXPECT_NE(first["problems"][0].get<std::string>().find("no picture matches '*absent.png'"),
            std::string::npos);
  const fs::path folder = folder_ / "out" / "tiny-lights";
  for (const auto& at : fs::recursive_directory_iterator(folder)) {
    if (at.path().filename() == "rsm.png") {
      fs::remove(at.path());
      break;
    }
  }
  EXPECT_EQ(make(options()).at("problems"), first.at("problems"));
}

TEST_F(Reproduce, WhatFailsCostsItself) {
  exhibit_.runs.insert(exhibit_.runs.begin(), (folder_ / "absent.json").string());
  exhibit_.claims.push_back("lights-reduce-blur");
  const Json made = make(options());
  ASSERT_EQ(made.at("problems").size(), 1u) << made.at("problems").dump();
  EXPECT_NE(made["problems"][0].get<std::string>().find("absent.json"), std::string::npos);
  EXPECT_EQ(made.at("tables").size(), 1u);
  // A claim that this run can't tell is named as not run.
  EXPECT_EQ(made["trials"].back()["ruling"], "not run");
}

TEST_F(Reproduce, AScaleThatTheConfigLacksIsAProblemOfItsOwn) {
  WorkOptions o = options();
  o.scale = "huge";
  const Json made = make(o);
  ASSERT_EQ(made.at("problems").size(), 1u) << made.at("problems").dump();
  EXPECT_NE(made["problems"][0].get<std::string>().find("it has quick"), std::string::npos);
}

}  // namespace
