// What the key `pdf` may name, and images as PDFs.
#include "run/pdf_source.h"

#include <cmath>
#include <limits>

#include "image/exr.h"
#include "image/png.h"
#include "run/config_fixture.h"

namespace vsglbench {
namespace {

class PdfSourceTest : public ConfigTest {
 protected:
  void SetUp() override {
    ConfigTest::SetUp();
    config_["measure"] = "generation";
    config_.erase("seeds");
    config_.erase("reference");
    config_["methods"] = {{{"method", "mfis"}}, {{"method", "fis"}}};
  }
  std::string exr(const std::string& name, const Image& image) const {
    write_exr(folder_ / name, image);
    return (folder_ / name).string();
  }
  std::string png(const std::string& name, const Bitmap& bitmap) const {
    write_png(folder_ / name, bitmap);
    return (folder_ / name).string();
  }
  std::string problem_with(const Json& pdf) {
    config_["pdf"] = pdf;
    return problem();
  }
};

TEST_F(PdfSourceTest, TellsItsKindsApart) {
  const std::string image = exr("p.exr", Image(2, 2, glm::vec3(1)));
  EXPECT_EQ(pdf_source("own").kind, PdfSource::Kind::own);
  EXPECT_EQ(pdf_source("flux").kind, PdfSource::Kind::flux);
  EXPECT_EQ(pdf_source("vpl").kind, PdfSource::Kind::method);
  EXPECT_EQ(pdf_source("vpl").name, "vpl");
  EXPECT_EQ(pdf_source(image).kind, PdfSource::Kind::image);
  EXPECT_EQ(pdf_source(image).name, image);
}

TEST_F(PdfSourceTest, WhatIsNoneIsSaidWhenTheConfigIsLoaded) {
  EXPECT_TRUE(contains(problem_with("mfsi"), "'pdf' no PDF 'mfsi'; did you mean 'mfis'?"));
  EXPECT_TRUE(contains(problem_with("flucks-of-light"), "known: own, flux, "));
  EXPECT_TRUE(
      contains(problem_with("all-texels"), "all-texels draws no lights that could make one; known: own"));
  EXPECT_TRUE(
      contains(problem_with((folder_ / "absent.exr").string()), "absent.exr': there is no such file"));
  EXPECT_TRUE(contains(problem_with(folder_.string()), "an image's path ends in .exr or .png"));
  EXPECT_TRUE(contains(problem_with(""), "pdf"));
  EXPECT_TRUE(contains(problem_with(3), "pdf"));
  EXPECT_TRUE(contains(problem_with({"mfis", "mfsi"}), "did you mean 'mfis'?"));
  EXPECT_TRUE(contains(problem_with(Json::array()), "is an empty list; give at least 1"));
  config_["pdf"] = "mfis";
  config_["methods"][1]["pdf"] = "mfsi";
  EXPECT_TRUE(contains(problem(), "'methods/1/pdf' no PDF 'mfsi'"));
}

TEST_F(PdfSourceTest, ImagesThatAreNoPdfAreRefusedWhenTheConfigIsLoaded) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  for (const float bad : {kNan, kInf, -1.0f}) {
    Image image(3, 2, glm::vec3(1));
    image.at(2, 1).g = 2 * bad;
    EXPECT_TRUE(contains(problem_with(exr("bad.exr", image)), "bad.exr: pixel (2, 1) has the luminance"))
        << bad;
  }
  EXPECT_TRUE(contains(problem_with(exr("black.exr", Image(4, 4))), "black.exr: is black"));
  EXPECT_TRUE(contains(problem_with(png("black.png", Bitmap(4, 4))), "black.png: is black"));
  for (const char* name : {"text.exr", "text.png"})
    EXPECT_TRUE(contains(problem_with(write(name, "no image").string()), name)) << name;
  std::string cut = read_text(exr("whole.exr", Image(64, 64, glm::vec3(1))));
  cut.resize(cut.size() / 2);
  EXPECT_TRUE(contains(problem_with(write("cut.exr", cut).string()), "cut.exr"));
}

TEST_F(PdfSourceTest, IsReadByDrawnLightsOfGenerationAlone) {
  config_["pdf"] = {"mfis", "flux"};
  EXPECT_EQ(ids(), (std::vector<std::string>{
                       "cornell/mfis/N=16,rsm=16,pdf=mfis", "cornell/mfis/N=16,rsm=16,pdf=flux",
                       "cornell/fis/N=16,rsm=16,pdf=mfis", "cornell/fis/N=16,rsm=16,pdf=flux"}));
  config_["methods"] = {{{"method", "mfis"}}, {{"method", "all-texels"}}};
  EXPECT_EQ(ids().back(), "cornell/all-texels/rsm=16");
  config_["methods"][1]["pdf"] = "flux";
  EXPECT_TRUE(contains(problem(), "is not read: all-texels draws no lights"));
  config_["methods"].erase(1);
  config_.erase("measure");
  EXPECT_TRUE(contains(problem(), "'pdf' is not read where whole frames are measured: there `importance`"));
  config_.erase("pdf");
  config_["methods"][0]["pdf"] = "flux";
  EXPECT_TRUE(contains(problem(), "'methods/0/pdf' is not read where whole frames are measured"));
  config_["methods"][0].erase("pdf");
  EXPECT_FALSE(load().resolved.contains("pdf") || load().resolved.contains("pdfs_made_by"));
}

TEST_F(PdfSourceTest, TheDefaultIsAsItWas) {
  EXPECT_EQ(ids().front(), "cornell/mfis/N=16,rsm=16");
  EXPECT_EQ(load().resolved.at("pdf"), "mfis");
  EXPECT_EQ(load().resolved.at("pdfs_made_by"), "mfis");
  EXPECT_FALSE(load().resolved.contains("pdf_images"));
}

TEST_F(PdfSourceTest, TheReportsConfigSaysWhoMadeThem) {
  const std::string image = exr("p.exr", Image(2, 2, glm::vec3(1)));
  config_["pdf"] = {"mfis", "own"};
  config_["methods"][1]["pdf"] = {"flux", image};
  const Json resolved = load().resolved;
  EXPECT_EQ(resolved.at("pdf"), (Json{"mfis", "own"}));
  EXPECT_EQ(resolved.at("pdfs_made_by"),
            "mfis; each method's own lights; the power that each texel reflects; the image " + image);
  const Json hash = resolved.at("pdf_images").at(image);
  EXPECT_EQ(hash.get<std::string>().size(), 32u);
  exr("p.exr", Image(2, 2, glm::vec3(2)));
  EXPECT_NE(load().resolved.at("pdf_images").at(image), hash);
}

TEST_F(PdfSourceTest, TwoFilesMayNotShareAnId) {
  std::filesystem::create_directories(folder_ / "a");
  config_["pdf"] = {exr("a/p.exr", Image(2, 2, glm::vec3(1))), exr("a-p.exr", Image(2, 2, glm::vec3(1)))};
  EXPECT_TRUE(contains(problem(), "makes two cases with the id mfis/N=16,rsm=16,pdf="));
}

// --- images ---

TEST_F(PdfSourceTest, ATexelHasTheMeanOverItsArea) {
  Image image(5, 3);
  for (uint32_t i = 0; i < 15; ++i) image.pixels[i] = glm::vec3(static_cast<float>(i * i + 1));
  const auto pdf = read_pdf_image(exr("p.exr", image), 2);
  // By points, 100 across and down a pixel.
  std::vector<double> sums(4, 0);
  for (uint32_t y = 0; y < 300; ++y) {
    for (uint32_t x = 0; x < 500; ++x) sums[2 * (y / 150) + x / 250] += image.at(x / 100, y / 100).r;
  }
  ASSERT_EQ(pdf.size(), 4u);
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(pdf[i], sums[i] / sums[3], 1e-6) << i;
}

TEST_F(PdfSourceTest, OfACoarserImageTheNearestPixel) {
  constexpr uint32_t kWidth = 3, kHeight = 4, kSide = 8;
  Image image(kWidth, kHeight);
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) image.pixels[i] = glm::vec3(static_cast<float>(i + 1));
  const auto pdf = read_pdf_image(exr("p.exr", image), kSide);
  const auto nearest = [](uint32_t texel, uint32_t pixels) {
    const auto distance = [&](uint32_t p) { return std::abs((texel + 0.5) / kSide - (p + 0.5) / pixels); };
    uint32_t best = 0;
    for (uint32_t p = 1; p < pixels; ++p) best = distance(p) < distance(best) ? p : best;
    return best;
  };
  ASSERT_EQ(pdf.size(), size_t{kSide} * kSide);
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x)
      EXPECT_NEAR(pdf[y * kSide + x], image.at(nearest(x, kWidth), nearest(y, kHeight)).r / 12, 1e-6)
          << x << " " << y;
  }
}

// Finer across, coarser down.
TEST_F(PdfSourceTest, EachAxisForItself) {
  Image image(4, 1);
  for (uint32_t i = 0; i < 4; ++i) image.pixels[i] = glm::vec3(static_cast<float>(i));
  EXPECT_EQ(read_pdf_image(exr("p.exr", image), 2), (std::vector<float>{0.2f, 1, 0.2f, 1}));
}

TEST_F(PdfSourceTest, IsTheLuminanceOfWhatAPngMeans) {
  Bitmap bitmap(3, 1, 4);
  const std::vector<uint8_t> rgba = {255, 255, 255, 0, 128, 128, 128, 255, 0, 255, 0, 255};
  bitmap.bytes = rgba;
  const auto pdf = read_pdf_image(png("p.png", bitmap), 3);
  EXPECT_NEAR(pdf[0], 1, 1e-6) << "alpha does not count";
  EXPECT_NEAR(pdf[1], 0.2158605, 1e-5);
  EXPECT_NEAR(pdf[2], 0.7152, 1e-6);
}

// Whatever its scale, also where a sum of its pixels has no single precision.
TEST_F(PdfSourceTest, ScaleDoesNotCount) {
  for (const float scale : {1e-36f, 1.0f, 3e38f}) {
    Image image(8, 8, glm::vec3(scale));
    image.at(0, 0) = glm::vec3(0);
    const auto pdf = read_pdf_image(exr("p.exr", image), 4);
    EXPECT_NEAR(pdf[0], 0.75, 1e-6) << scale;
    EXPECT_EQ(pdf[15], 1) << scale;
  }
}

}  // namespace
}  // namespace vsglbench
