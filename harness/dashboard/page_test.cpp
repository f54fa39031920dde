#include "dashboard/page.h"

#include "base/error.h"
#include "dashboard/page_fixture.h"
#include "image/png.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

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
  ASSERT_EQ(some.digest.at("notes").size(), 1);
  const std::string told = fmt::format("{} pictures are left out", 4 - some.pictures.size());
  EXPECT_TRUE(some.digest.at("notes")[0].get<std::string>().starts_with(told)) << some.digest.at("notes");
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

// What `ci/regenerate-reports` keeps beside a committed report.
TEST_F(PageTest, WithoutImagesTheKeptFlickerPicturesAreTaken) {
  const fs::path folder = report_with_pictures();
  const auto flicker_of = [&](size_t i, const std::string& path) { made_.cases[i].images["flicker"] = path; };
  flicker_of(0, "images/box/fis/b.flicker.png");
  flicker_of(1, "images/box/fis/a.flicker.png");
  flicker_of(2, "images/box/vpl/a.flicker.png");
  fs::remove_all(folder / "images");
  write_text(folder / "box-fis.flicker.png", encode_png(tone_map(Image(8, 4), 1)));
  const Dashboard d = dashboard(folder);
  ASSERT_EQ(d.pictures.size(), 1);
  EXPECT_EQ(d.pictures[0].entry.at("kind"), "flicker");
  EXPECT_EQ(d.pictures[0].entry.at("case"), 1);  // the first by the name of its picture
  ASSERT_EQ(d.digest.at("notes").size(), 1);
  EXPECT_TRUE(d.digest.at("notes")[0].get<std::string>().ends_with("but those of flicker in the page"));
  fs::remove(folder / "box-fis.flicker.png");
  EXPECT_TRUE(dashboard(folder).digest.at("notes")[0].get<std::string>().ends_with("no picture in the page"));
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
