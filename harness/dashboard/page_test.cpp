#include "dashboard/page.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "answer/made_report.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/png.h"
#include "report/synthetic_report.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class PageTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / fmt::format("vsglbench-page-{}-{}", info->name(), ::getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // A report of three cases with pictures: two of the front, and one that is worse in both.
  fs::path report_with_pictures(const std::string& name = "made") {
    MadeReport m(1, 0.01, 0.02);
    m.add({"box", "fis", {{"N", 64}, {"visibility", "none"}}, {{"shade", 1}}, 20});
    m.add({"box", "fis", {{"N", 256}, {"visibility", "none"}}, {{"shade", 4}}, 10});
    m.add({"box", "vpl", {{"N", 256}, {"visibility", "none"}}, {{"shade", 8}}, 40});
    // What the schema asks for beside that.
    made_ = synthetic_report();
    made_.aa.clear();
    made_.scenes[0].name = "box";
    made_.scenes[0].exposure = 2;
    made_.scenes[0].effects_priced.reset();
    for (CaseResult& c : m.report.cases) {
      const CaseResult whole = synthetic_case(c.id);
      c.generate = whole.generate;
      c.health = whole.health;
      c.stopping = whole.stopping;
      c.accuracy->quantiles = whole.accuracy->quantiles;
    }
    made_.cases = m.report.cases;
    const fs::path folder = folder_ / name;
    fs::create_directories(folder / "images");
    for (size_t i = 0; i < made_.cases.size(); ++i) {
      Image image(8, 4);
      for (size_t p = 0; p < image.pixels.size(); ++p) image.pixels[p] = glm::vec3(float(p), float(i), 0.1f);
      const std::string file = fmt::format("images/{}.exr", i);
      write_exr(folder / file, image);
      write_exr(folder / "images/reference.exr", image);
      made_.cases[i].images = {{"indirect", file}, {"reference", "images/reference.exr"}, {"error", file}};
    }
    return folder;
  }
  Dashboard dashboard(const fs::path& folder, const PictureOrder& pictures = {}) {
    write(folder);
    return make_dashboard({{folder}, {}, {}, pictures});
  }
  void write(const fs::path& folder) { std::ofstream(folder / "report.json") << to_json(made_).dump(); }

  fs::path folder_;
  Report made_;
};

std::string text_between(const std::string& text, const std::string& from, const std::string& to) {
  const size_t a = text.find(from) + from.size();
  return text.substr(a, text.find(to, a) - a);
}

std::string decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
    have += 6;
    if (have >= 8) out += static_cast<char>(bits >> (have -= 8) & 255);
  }
  return out;
}

// RFC 4648 §10.
TEST(Base64, TestVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST_F(PageTest, TheFrontComesAsExrAndTheRestAsPng) {
  const Dashboard d = dashboard(report_with_pictures());
  ASSERT_EQ(d.pictures.size(), 4);
  EXPECT_EQ(d.pictures[0].entry.at("kind"), "reference");
  EXPECT_EQ(d.pictures[0].entry.at("case"), -1);
  for (const size_t i : {1, 2}) {
    EXPECT_EQ(d.pictures[i].entry.at("format"), "exr");
    EXPECT_EQ(d.pictures[i].entry.at("case"), i - 1);
  }
  EXPECT_EQ(d.pictures[3].entry.at("format"), "png");
  // What is embedded is what the file says, to half a half float's step.
  const fs::path copy = folder_ / "copy.exr";
  write_text(copy, decoded(d.pictures[2].base64));
  const Image image = read_exr(copy);
  ASSERT_EQ(image.width, 8);
  EXPECT_EQ(image.at(3, 2), glm::vec3(19, 1, image.at(0, 0).z));
  EXPECT_NEAR(image.at(0, 0).z, 0.1, 0.1 / 2048);
  write_text(folder_ / "copy.png", decoded(d.pictures[3].base64));
  EXPECT_EQ(read_png(folder_ / "copy.png").at(0, 0)[1], encode_srgb(2 * 2));
}

TEST_F(PageTest, AskedForCasesComeAsExrToo) {
  PictureOrder order;
  order.cases = {"box/vpl/*"};
  EXPECT_EQ(dashboard(report_with_pictures(), order).pictures[3].entry.at("format"), "exr");
  order.mode = PictureMode::png;
  for (const Picture& p : dashboard(report_with_pictures(), order).pictures)
    EXPECT_EQ(p.entry.at("format"), "png");
  order.mode = PictureMode::none;
  EXPECT_TRUE(dashboard(report_with_pictures(), order).pictures.empty());
  EXPECT_THROW(picture_mode("jpg"), Error);
}

TEST_F(PageTest, PicturesKeepToTheirSize) {
  const fs::path folder = report_with_pictures();
  const Dashboard all = dashboard(folder);
  PictureOrder order;
  order.max_mb =
      1e-6 * static_cast<double>(all.pictures[0].base64.size() + all.pictures[1].base64.size() + 2);
  const Dashboard some = dashboard(folder, order);
  double total = 0;
  for (const Picture& p : some.pictures) total += static_cast<double>(p.base64.size());
  EXPECT_LE(total, 1e6 * order.max_mb);
  EXPECT_LT(some.pictures.size(), 4);
  EXPECT_EQ(some.digest.at("images_left_out").get<size_t>() + some.pictures.size(), 4);
  EXPECT_EQ(some.digest.at("notes").size(), 1);
}

TEST_F(PageTest, MissingDamagedAndForeignPicturesAreTold) {
  const fs::path folder = report_with_pictures();
  fs::remove(folder / "images/0.exr");
  write_text(folder / "images/1.exr", "no EXR");
  write_text(folder_ / "secret.exr", read_text(folder / "images/2.exr"));
  made_.cases[2].images["indirect"] = "../secret.exr";
  const Dashboard d = dashboard(folder);
  EXPECT_EQ(d.pictures.size(), 1);
  ASSERT_EQ(d.digest.at("notes").size(), 3);
  EXPECT_NE(d.digest.at("notes")[2].get<std::string>().find("outside"), std::string::npos);
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

TEST_F(PageTest, TwoAreComparedAndThreeAreAHistory) {
  std::vector<fs::path> folders;
  for (const char* name : {"a", "b", "c"}) {
    folders.push_back(report_with_pictures(name));
    made_.created = std::string("2026-01-0") +
                    (name[0] == 'a'   ? '3'
                     : name[0] == 'b' ? '1'
                                      : '2') +
                    "T00:00:00Z";
    made_.kernels = std::string(32, name[0]);
    write(folders.back());
  }
  const Json two = make_dashboard({{folders[0], folders[1]}, {}, {}, {}}).digest;
  EXPECT_EQ(two.at("reports").size(), 2);
  EXPECT_EQ(two.at("reports")[0].at("file"), "a");
  EXPECT_FALSE(two.at("comparison").at("rows").empty());
  EXPECT_EQ(two.at("comparison").at("exit_code"), 0);
  EXPECT_TRUE(two.at("history").is_null());
  const Json three = make_dashboard({folders, {}, {}, {}}).digest;
  EXPECT_EQ(three.at("reports").size(), 1);
  EXPECT_EQ(three.at("reports")[0].at("file"), "a");
  std::string order;
  for (const Json& r : three.at("history").at("reports")) order += r.at("file").get<std::string>();
  EXPECT_EQ(order, "bca");
  EXPECT_THROW(make_dashboard({{folder_ / "nothing"}, {}, {}, {}}), Error);
}

TEST_F(PageTest, ReportsOfOtherMachinesAreLeftOutOfAHistory) {
  std::vector<fs::path> folders;
  for (const char* name : {"a", "b", "c"}) {
    folders.push_back(report_with_pictures(name));
    made_.created = std::string("2026-01-0") + static_cast<char>('1' + name[0] - 'a') + "T00:00:00Z";
    if (name[0] == 'a') made_.device.name = "another";
    write(folders.back());
  }
  const Json d = make_dashboard({folders, {}, {}, {}}).digest;
  EXPECT_EQ(d.at("history").at("reports").size(), 2);
  ASSERT_FALSE(d.at("notes").empty());
  EXPECT_NE(d.at("notes")[0].get<std::string>().find("1 of 3"), std::string::npos);
}

}  // namespace
}  // namespace vsglbench
