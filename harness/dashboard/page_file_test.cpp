// The page as a file: of builds that have one.
#include <zlib.h>

#include "dashboard/page_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

std::string text_between(const std::string& text, const std::string& from, const std::string& to) {
  const size_t a = text.find(from) + from.size();
  return text.substr(a, text.find(to, a) - a);
}

TEST_F(PageTest, ThePageHoldsTheDigest) {
  const fs::path folder = report_with_pictures();
  made_.cases[2].method = "</script><script>alert(1)</script>";
  const Dashboard d = dashboard(folder);
  const fs::path out = folder_ / "page.html";
  write_dashboard(d, out);
  const std::string page = read_text(out);
  EXPECT_EQ(page.find("alert(1)"), std::string::npos);
  const std::string packed = decoded(text_between(page, "id=\"data\">", "</script>"));
  std::string text(1 << 20, '\0');
  uLongf size = text.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  text.resize(size);
  EXPECT_EQ(Json::parse(text), d.digest);
  EXPECT_EQ(text_between(page, "id=\"image-0-1\">", "</script>"), d.pictures[1].base64);
}

}  // namespace
}  // namespace vsglbench
