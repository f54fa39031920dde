// `vsglbench stability` as a user meets it.
#include <gtest/gtest.h>

#include <set>

#include "base/json.h"
#include "cli/process.h"

namespace vsglbench {
namespace {

Finished run(std::vector<std::string> more) {
  more.insert(more.begin(), "stability");
  return finish(start(more));
}

void expect_refused(const std::vector<std::string>& arguments, const std::string& part) {
  const Finished f = run(arguments);
  EXPECT_EQ(f.code, 2) << f.err;
  ASSERT_EQ(f.errors().size(), 1u) << f.err;
  EXPECT_NE(f.err.find(part), std::string::npos) << f.err;
  EXPECT_EQ(f.out, "");
}

const std::string kBadPlugins = bad_plugins();

}  // namespace

TEST(StabilityCommand, JsonHasEachCaseWithEachMethodAndKernel) {
  const Finished f = run({"--json", "--method", "mfis", "--method", "vpl", "--case", "on-light", "--case",
                          "far-1e5", "--case", "k-1e6", "--diffuse", "cosine", "--diffuse", "tokuyoshi2024"});
  ASSERT_EQ(f.code, 0) << f.err << f.out;
  const Json json = Json::parse(f.out);
  std::set<std::string> cells;
  for (const Json& c : json.at("cells")) {
    cells.insert(c.at("case").get<std::string>() + " " + c.at("method").get<std::string>() + " " +
                 c.at("diffuse").get<std::string>() + " " + c.at("status").get<std::string>());
    EXPECT_FALSE(c.at("why").get<std::string>().empty());
    EXPECT_TRUE(c.at("error").is_number());
  }
  EXPECT_EQ(cells, (std::set<std::string>{"on-light mfis cosine ok", "on-light mfis tokuyoshi2024 ok",
                                          "on-light vpl - ok", "far-1e5 mfis cosine ok", "far-1e5 vpl - ok",
                                          "k-1e6 mfis cosine ok", "k-1e6 vpl - left out"}));
  EXPECT_EQ(json.at("counts").at("ok"), 6);
}

TEST(StabilityCommand, SaysWhereTheWorstErrorIs) {
  const Finished f = run({"--method", "vpl", "--case", "gentle", "--case", "n-above-texels"});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_NE(f.out.find("pixel ("), std::string::npos) << f.out;
  EXPECT_NE(f.out.find("refused: N = 577 lights can't be drawn"), std::string::npos) << f.out;
  EXPECT_NE(f.out.find("2 cells, 2 ok"), std::string::npos) << f.out;
}

// What goes wrong costs its own cell: the cases after it are tried.
TEST(StabilityCommand, ABadMethodIsBadAndNothingElse) {
  const Finished f =
      finish(start({"--plugin-path", kBadPlugins, "stability", "--method", "crashes", "--method",
                    "returns-nan", "--method", "vpl", "--case", "gentle", "--case", "n-1", "--json"}));
  EXPECT_EQ(f.code, 1) << f.err;
  std::set<std::string> statuses, why;
  const Json json = Json::parse(f.out);
  for (const Json& c : json.at("cells")) {
    statuses.insert(c.at("case").get<std::string>() + " " + c.at("method").get<std::string>() + " " +
                    c.at("status").get<std::string>());
    why.insert(c.at("why").get<std::string>());
  }
  EXPECT_EQ(statuses, (std::set<std::string>{"gentle crashes bad", "gentle returns-nan bad", "gentle vpl ok",
                                             "n-1 crashes bad", "n-1 returns-nan bad", "n-1 vpl ok"}));
  EXPECT_TRUE(why.contains("crashed (signal 11, Segmentation fault)")) << f.out;
}

TEST(StabilityCommand, RefusesWhatItDoesNotKnow) {
  expect_refused({"--case", "on-ligth"}, "no case 'on-ligth'; did you mean 'on-light'?");
  expect_refused({"--method", "mfiss"}, "mfis");
  expect_refused({"--diffuse", "tokuyoshi"}, "no diffuse model 'tokuyoshi'");
  expect_refused({"--time-limit", "0"}, "--time-limit");
}

}  // namespace vsglbench
