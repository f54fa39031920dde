// `vsglbench reproduce` as a user meets it.
#include <gtest/gtest.h>

#include "base/file.h"
#include "cli/cli_fixture.h"

namespace vsglbench {
namespace {

class ReproduceCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    const Json config = {{"name", "tiny"},
                         {"scenes", {"cornell"}},
                         {"methods", {{{"method", "fis"}}, {{"method", "mfis"}}}},
                         {"frame", {{"width", 32}, {"height", 20}}},
                         {"rsm", 32},
                         {"N", 16},
                         {"importance_lights", 16},
                         {"visibility", "none"},
                         {"seeds", 4},
                         {"reference", {{"samples", 16}}},
                         {"timing", {{"min_samples", 2}, {"max_samples", 2}, {"warmup", 0}}},
                         {"scales", {{"quick", {{"N", 8}}}}}};
    const std::string tiny = write("tiny.json", config.dump()).string();
    const Json claims = {{"claims",
                          {{{"name", "same"},
                            {"text", "Both err alike"},
                            {"source", "[P §5]"},
                            {"a", {{"method", "mfis"}}},
                            {"b", {{"method", "fis"}}},
                            {"says", "less"},
                            {"factor", 100},
                            {"metrics", {"rmse"}}}}}};
    const Json exhibits = {
        {"exhibits",
         {{{"name", "one"},
           {"source", "[P Fig. 1]"},
           {"title", "First"},
           {"runs", {tiny}},
           {"claims", {"same"}},
           {"sheet", {{{"run", tiny}, {"images", {"reference", "indirect"}}}}}},
          {{"name", "two"}, {"source", "[P Tab. 1]"}, {"title", "Second"}, {"runs", {tiny}}}}}};
    command_ = {"-q",         "reproduce",
                "--exhibits", write("exhibits.json", exhibits.dump()).string(),
                "--claims",   write("claims.json", claims.dump()).string(),
                "--out",      out_.string(),
                "--page",     (folder_ / "page").string()};
  }
  Finished reproduce(const std::vector<std::string>& more) const {
    std::vector<std::string> all = command_;
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  Json papers() const { return Json::parse(read_text(folder_ / "page" / "papers.json")); }
  std::vector<std::string> command_;
};

TEST_F(ReproduceCommand, MakesAPageAndChecksAgainstIt) {
  const Finished first = reproduce({});
  ASSERT_EQ(first.code, 0) << first.out << first.err;
  EXPECT_TRUE(contains(first.out, "holds")) << first.out;
  EXPECT_TRUE(contains(first.out, (folder_ / "page" / "README.md").string())) << first.out << first.err;
  EXPECT_TRUE(contains(read_text(folder_ / "page" / "README.md"), "Both err alike"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "page" / "one.png"));
  ASSERT_EQ(papers()["exhibits"].size(), 2u);
  EXPECT_EQ(papers()["exhibits"][0]["scale"], "quick");
  EXPECT_EQ(papers()["exhibits"][0]["command"], "vsglbench reproduce one --scale quick --exhibits " +
                                                    (folder_ / "exhibits.json").string() + " --claims " +
                                                    (folder_ / "claims.json").string());

  // One alone: the other keeps its place. What is finished is not measured again.
  ASSERT_EQ(reproduce({"two"}).code, 0);
  ASSERT_EQ(papers()["exhibits"].size(), 2u);
  EXPECT_EQ(papers()["exhibits"][1]["measured"], papers()["exhibits"][0]["measured"]);

  const Finished same = reproduce({"--check"});
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  EXPECT_TRUE(contains(same.out, "1 verdicts compared: 0 flipped"));
  Json other = papers();
  other["exhibits"][0]["trials"][0]["ruling"] = "does not hold";
  write_text(folder_ / "page" / "papers.json", other.dump());
  const Finished flipped = reproduce({"--check"});
  EXPECT_EQ(flipped.code, 4) << flipped.out << flipped.err;
  EXPECT_TRUE(contains(flipped.out, "FLIPPED [P §5]: now holds: Both err alike (one, cornell, rmse;"));
  EXPECT_EQ(papers()["exhibits"][0]["trials"][0]["ruling"], "does not hold");  // the page is left alone
}

TEST_F(ReproduceCommand, RefusesWhatItCannotMake) {
  expect_refused(reproduce({"three"}), 2, "no table or figure 'three'; known: all, one");
  EXPECT_TRUE(contains(run({"reproduce", "--help"}).out, "Names: all, mfis16-tab1, "));
  for (const std::string option : {"--out", "--page", "--against", "--exhibits", "--claims"})
    expect_refused(run({"reproduce", "three", option, ""}), 2, option + ": is empty; give a path");
  expect_refused(reproduce({"--scale", "huge"}), 2, "--scale");
  write("damaged.json", "{\"schema\": \"vsglbench.papers/1\", \"exhibits\": [{}]}");
  expect_refused(reproduce({"one", "--check", "--against", (folder_ / "absent.json").string()}), 2,
                 "does not exist");
  expect_refused(reproduce({"one", "--force", "--as-is"}), 2, "give one of them");
  expect_refused(reproduce({"one", "--check", "--against", (folder_ / "damaged.json").string()}), 2,
                 "damaged.json:1: is no page's JSON");
}

TEST_F(ReproduceCommand, AMisspeltClaimIsTold) {
  const Finished f =
      run({"reproduce", "--exhibits", write("bad.json", R"({"exhibits": [{"name": "x"}]})").string()});
  expect_refused(f, 2, "bad.json:1");
}

}  // namespace
}  // namespace vsglbench
