#include "cli/cli_fixture.h"
#include "report/synthetic_report.h"

namespace vsglbench {
namespace {

class TableCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    write_report(folder_ / "reports/a/report.json", synthetic_report());
    readme_ = write("README.md", "<!-- table reports/a/report.json -->\n<!-- end of table -->\n").string();
  }
  std::string readme_;
};

TEST_F(TableCommand, PrintsAReport) {
  const Finished text = run({"table", (folder_ / "reports/a").string()});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_TRUE(contains(text.out, "method ms"));
  const Finished markdown = run({"table", (folder_ / "reports/a/report.json").string(), "--columns",
                                 "smape,method", "--across", "method", "--only", "*/mfis", "--markdown"});
  EXPECT_EQ(markdown.code, 0) << markdown.err;
  EXPECT_TRUE(contains(markdown.out, "| case | mfis | noise floor |"));
}

TEST_F(TableCommand, FillsAndChecks) {
  expect_refused(run({"table", "--fill", "--check", readme_}), 1, "README.md:2: not what its report says");
  EXPECT_EQ(run({"table", "--fill", folder_.string()}).code, 0);
  EXPECT_TRUE(contains(read_text(readme_), "| cornell mfis | 12.00"));
  const Finished f = run({"table", "--fill", "--check", folder_.string()});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, "1 tables in 1 files: as their reports say"));
  std::string text = read_text(readme_);
  text.replace(text.find("12.00"), 5, "11.00");  // one digit
  write_text(readme_, text);
  expect_refused(run({"table", "--fill", "--check", folder_.string()}), 1,
                 "README.md:5: not what its report says");
  EXPECT_EQ(read_text(readme_), text);
}

TEST_F(TableCommand, BadUsageIsOneLine) {
  expect_refused(run({"table", readme_ + "x", "--fill"}), 2, "no such file");
  expect_refused(run({"table", readme_, "--check"}), 2, "give both");
  expect_refused(run({"table", readme_, "--fill", "--across", "N"}), 2, "give them there");
  expect_refused(run({"table", readme_}), 2, "README.md:1: not JSON");
  expect_refused(run({"table", write("plain.md", "text\n").string(), "--fill"}), 2, "holds a table");
  expect_refused(run({"table", (folder_ / "reports/a").string(), "--columns", "fram"}), 2,
                 "did you mean 'frame'?");
}

TEST_F(CliTest, ARunThatIsNoisierThanRequiredFailsWithItsReport) {
  const auto with = [&](const std::string& noise) {
    return run({"-q", "run", write_config().string(), "--out", out_.string(), "--require-noise", noise});
  };
  expect_refused(with("5"), 2, "a percentage above 0, such as 5%, not '5'");
  expect_refused(with("-5%"), 2, "not '-5%'");
  EXPECT_FALSE(std::filesystem::exists(out_ / "report.json"));
  // Two frames of microseconds are never within a millionth of each other, and always within a factor 10⁴.
  expect_refused(with("0.0001%"), 1, "cornell: the time '");
  EXPECT_TRUE(report().complete);
  EXPECT_EQ(report().aa.size(), 1u);
  EXPECT_EQ(with("1e6%").code, 0);
}

}  // namespace
}  // namespace vsglbench
