// dashboard writes a page, on a committed report: of builds that have one.
#include "base/file.h"
#include "cli/cli_fixture.h"

namespace vsglbench {
namespace {

const std::string kReports = std::string(VSGLBENCH_SOURCE_DIR) + "/reports/";

TEST_F(CliTest, DashboardWritesOnePage) {
  const std::string page = (folder_ / "deep" / "page.html").string();
  const Finished f = run({"dashboard", kReports + "cut-lavapipe", "--out", page, "--papers",
                          kReports + "papers/lavapipe/papers.json"});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(contains(f.out, page)) << f.out;
  EXPECT_TRUE(contains(f.err, "no folder images/ beside the report")) << f.err;
  const std::string text = read_text(page);
  EXPECT_TRUE(contains(text, "id=\"data\">"));
  EXPECT_FALSE(contains(text, "<!--data-->"));
  // What a browser would fetch: a page from a file may ask nothing of a network.
  EXPECT_FALSE(contains(text, "src=\""));
  EXPECT_FALSE(contains(text, "href=\""));
}

TEST_F(CliTest, DashboardWritesToAPipe) {
  const Finished f = run({"dashboard", kReports + "cut-lavapipe", "--out", "/dev/stdout"});
  EXPECT_EQ(f.code, 0) << f.err;
  EXPECT_TRUE(f.out.starts_with("<!")) << f.out.substr(0, 80);
  EXPECT_TRUE(f.out.ends_with("</html>\n"))
      << f.out.substr(f.out.size() - std::min<size_t>(80, f.out.size()));
}

}  // namespace
}  // namespace vsglbench
